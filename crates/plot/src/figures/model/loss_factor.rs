//! Loss factor over frequency.

use super::curves::{Kind, draw};
use super::{ModelCurve, ModelFigure, ModelSeries, ModelSubject};
use crate::{Chart, Scale};

/// Loss factor `tan δ`, the ratio of loss to storage, over angular frequency.
#[derive(Debug, Clone, Copy)]
pub struct LossFactor;

impl ModelFigure for LossFactor {
    fn name(&self) -> &'static str {
        "loss-factor"
    }

    fn title(&self, _subject: ModelSubject) -> &'static str {
        "Loss factor"
    }

    fn chart(&self, models: &[ModelSeries], subject: ModelSubject) -> Chart {
        let kinds = [Kind { curve: ModelCurve::LossFactor, name: "loss factor", colour: 0 }];
        let drawn = draw(models, &kinds);
        Chart {
            title: self.title(subject).into(),
            note: drawn.note,
            x_label: "angular frequency".into(),
            y_label: "loss factor tan δ".into(),
            x_scale: Scale::logarithmic("rad/s"),
            y_scale: Scale::logarithmic(""),
            series: drawn.series,
            markers: drawn.markers,
            ..Chart::default()
        }
    }
}
