//! The magnitude of what several axes of one location measure.

use super::{Analysis, Treated, defects::defects};
use crate::{Axis, Channel, Defect, Noise, Place, sampling::Sampling};

/// What a channel holds of what happens at its place.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Part {
    /// All of it, as far as its name tells.
    #[default]
    Whole,
    /// What acts along one axis.
    Axis(Place),
    /// The magnitude of what acts along some axes, each with the name of its channel.
    Resultant {
        /// What the names of the axes have in common.
        location: String,
        /// The axes, in their order.
        of: Vec<(Axis, String)>,
    },
}

impl Part {
    /// The axes that it holds; none where it is all as far as its name tells.
    pub fn axes(&self) -> Vec<Axis> {
        match self {
            Self::Whole => Vec::new(),
            Self::Axis(place) => vec![place.axis],
            Self::Resultant { of, .. } => of.iter().map(|own| own.0).collect(),
        }
    }

    /// Whether it holds all of a motion along these axes.
    pub fn covers(&self, along: &[Axis]) -> bool {
        let axes = self.axes();
        axes.is_empty() || along.iter().all(|own| axes.contains(own))
    }

    /// What the names of the axes of its place have in common; `None` where nothing tells a place.
    pub fn location(&self) -> Option<&str> {
        match self {
            Self::Whole => None,
            Self::Axis(Place { location, .. }) | Self::Resultant { location, .. } => Some(location),
        }
    }

    fn place(&self) -> Option<&Place> {
        match self {
            Self::Axis(place) => Some(place),
            _ => None,
        }
    }
}

impl Analysis {
    /// The resultants of the channels of a file that are axes of one location: two or three with the same quantity, and
    /// with the same filter class where codes tell one. Axes without their resultant have a defect that says why. Where
    /// a channel has the name of a resultant, it was recorded, and is none of these.
    pub fn resultants(all: &mut [Self]) -> Vec<Self> {
        let mut resultants = Vec::new();
        for at in 0..all.len() {
            let beside: Vec<usize> =
                (0..all.len()).filter(|own| all[at].is_beside(&all[*own])).collect();
            let class = |own: usize| all[own].part.place().and_then(|own| own.class);
            let alike: Vec<usize> =
                beside.iter().copied().filter(|own| class(*own) == class(at)).collect();
            if alike.first() != Some(&at) || beside.len() < 2 {
                continue;
            }
            let axes = |some: &[usize]| {
                Axis::ALL.map(|axis| some.iter().any(|own| all[*own].part.axes() == [axis]))
            };
            if axes(&alike) != axes(&beside) {
                let others: Vec<usize> =
                    beside.into_iter().filter(|own| !alike.contains(own)).collect();
                Self::leave_apart(all, &alike, &others, Some(Defect::OtherFilter));
            }
            let Some(place) = all[at].part.place().filter(|_| alike.len() > 1) else { continue };
            let name = place.resultant.clone();
            if all.iter().any(|own| own.channel.name() == name) {
                Self::leave_apart(all, &alike, &alike, None);
                continue;
            }
            let axes: Vec<&Self> = alike.iter().map(|own| &all[*own]).collect();
            match Self::resultant(name, &place.location, axes) {
                Ok(own) => resultants.push(own),
                Err(defect) => Self::leave_apart(all, &alike, &alike, Some(defect)),
            }
        }
        resultants
    }

    /// Tells of some axes that others of their location, and of two channels of one axis the other one, form no resultant
    /// with them.
    fn leave_apart(all: &mut [Self], some: &[usize], others: &[usize], defect: Option<Defect>) {
        let is_twice = defect == Some(Defect::AxisTwice);
        for at in some {
            let axes = all[*at].part.axes();
            let is_other = |own: &&usize| is_twice && *own != at || all[**own].part.axes() != axes;
            let others = others.iter().filter(is_other);
            let names: Vec<String> =
                others.map(|own| all[*own].channel.name().to_owned()).collect();
            all[*at].beside.extend(names);
            all[*at].defects.extend(defect);
        }
    }

    fn is_beside(&self, other: &Self) -> bool {
        let is_one = |(one, other): (&Place, &Place)| one.is_beside(other);
        self.channel.dimension() == other.channel.dimension()
            && self.part.place().zip(other.part.place()).is_some_and(is_one)
    }

    /// That of some axes, at the times of the one with the most samples, over what they have in common. How far it may
    /// be off is the root of the sum of squares of what they may be, with what lines between other times hide; its noise is the largest of them.
    fn resultant(name: String, location: &str, mut axes: Vec<&Self>) -> Result<Self, Defect> {
        axes.sort_by_key(|own| own.part.axes());
        if axes.windows(2).any(|own| own[0].part.axes() == own[1].part.axes()) {
            return Err(Defect::AxisTwice);
        }
        let spans = axes.iter().map(|own| own.channel.span());
        let common = |one: (f64, f64), other: (f64, f64)| (one.0.max(other.0), one.1.min(other.1));
        let (from, to) = spans.fold((f64::NEG_INFINITY, f64::INFINITY), common);
        let is_inside = |time: &f64| (from..=to).contains(time);
        let has_peak =
            |own: &&Self| own.channel.times().get(own.channel.largest().0).is_some_and(is_inside);
        let Some(finest) = axes.iter().max_by_key(|own| own.channel.times().len()) else {
            return Err(Defect::AxesApart);
        };
        let times: Vec<f64> = finest.channel.times().iter().copied().filter(is_inside).collect();
        if !axes.iter().all(has_peak) || times.len() < 2 {
            return Err(Defect::AxesApart);
        }
        let norm = |parts: &mut dyn Iterator<Item = f64>| parts.fold(0.0, f64::hypot);
        let is_sampled = |own: &Self| own.channel.times() == finest.channel.times();
        let floor = norm(&mut axes.iter().map(|own| {
            let hidden = if is_sampled(own) { 0.0 } else { Sampling::of(&own.channel).height() };
            own.uncertainty.floor + own.beyond + hidden
        }));
        let most = |of: fn(&Noise) -> f64| {
            axes.iter().map(|own| of(&own.uncertainty.noise)).fold(0.0, f64::max)
        };
        let noise = Noise {
            deviation: most(|own| own.deviation),
            intensity: most(|own| own.intensity),
            is_of_rest: axes.iter().all(|own| own.uncertainty.noise.is_of_rest),
        };
        let values =
            times.iter().map(|time| norm(&mut axes.iter().map(|own| own.channel.value(*time))));
        let channel =
            Channel::new(name, finest.channel.dimension(), times.clone(), values.collect());
        let channel = channel.map_err(|_| Defect::AxesApart)?;
        let of = axes.iter().flat_map(|own| {
            own.part.axes().into_iter().map(|axis| (axis, own.channel.name().to_owned()))
        });
        let part = Part::Resultant { location: location.to_owned(), of: of.collect() };
        let settings = crate::Settings { approach: None, ..finest.settings };
        // Noise across the vector makes it longer, by half of its variance over the length.
        let longer = axes.len() as f64 * noise.deviation.powi(2) / channel.largest().1;
        let floor = floor + if longer.is_finite() { longer } else { 0.0 };
        let raw = channel.clone();
        let (offset, behind, sag, removed, at_rest) = (None, None, None, None, None);
        let treated = Treated { channel, offset, behind, sag, removed, floor, rest: 0.0, at_rest };
        let clipped = axes.iter().flat_map(|own| own.clipped.iter().copied()).collect();
        let mut own = settings.read(raw, treated, noise, (part, clipped));
        own.defects = defects(&own);
        for other in axes {
            own.beside.extend(other.beside.iter().cloned());
            let axis = other.part.place().map(|own| own.axis);
            own.defects.extend(other.defects.iter().filter_map(|defect| match *defect {
                Defect::Clipped { level, samples, time, unit, .. } => {
                    Some(Defect::Clipped { axis, level, samples, time, unit })
                }
                _ => None,
            }));
        }
        own.beside.sort();
        own.beside.dedup();
        if own.part.axes().len() == Axis::ALL.len() {
            own.beside.clear();
        }
        Ok(own)
    }
}
