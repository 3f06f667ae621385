//! Storage and loss over frequency.

use super::curves::{Kind, draw};
use super::{ModelCurve, ModelFigure, ModelSeries, ModelSubject};
use crate::{Chart, Scale};

/// Storage and loss over angular frequency.
#[derive(Debug, Clone, Copy)]
pub struct Sweep;

impl ModelFigure for Sweep {
    fn name(&self) -> &'static str {
        "sweep"
    }

    fn title(&self, subject: ModelSubject) -> &'static str {
        match subject {
            ModelSubject::Pad => "Storage and loss stiffness",
            ModelSubject::Material => "Storage and loss modulus",
        }
    }

    fn chart(&self, models: &[ModelSeries], subject: ModelSubject) -> Chart {
        // A dark and a light colour, which differ in print without colours too.
        let kinds = [
            Kind { curve: ModelCurve::Storage, name: "storage", colour: 0 },
            Kind { curve: ModelCurve::Loss, name: "loss", colour: 4 },
        ];
        let drawn = draw(models, &kinds);
        Chart {
            title: self.title(subject).into(),
            note: drawn.note,
            x_label: "angular frequency".into(),
            y_label: subject.stiffness().into(),
            x_scale: Scale::logarithmic("rad/s"),
            y_scale: Scale::logarithmic(subject.stiffness_unit()),
            series: drawn.series,
            markers: drawn.markers,
            ..Chart::default()
        }
    }
}
