//! Creep function over time.

use super::curves::{Kind, draw};
use super::{ModelCurve, ModelFigure, ModelSeries, ModelSubject};
use crate::{Chart, Scale};

/// Creep function `J(t)` over time.
#[derive(Debug, Clone, Copy)]
pub struct Creep;

impl ModelFigure for Creep {
    fn name(&self) -> &'static str {
        "creep"
    }

    fn title(&self, _subject: ModelSubject) -> &'static str {
        "Creep compliance"
    }

    fn chart(&self, models: &[ModelSeries], subject: ModelSubject) -> Chart {
        let kinds = [Kind { curve: ModelCurve::Creep, name: "creep", colour: 0 }];
        let drawn = draw(models, &kinds);
        Chart {
            title: self.title(subject).into(),
            note: drawn.note,
            x_label: "time".into(),
            y_label: "creep compliance".into(),
            x_scale: Scale::logarithmic("s"),
            y_scale: Scale::logarithmic(subject.compliance_unit()),
            series: drawn.series,
            markers: drawn.markers,
            ..Chart::default()
        }
    }
}
