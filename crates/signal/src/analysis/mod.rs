//! From a raw channel to its numbers.

pub(crate) mod defects;
pub(crate) mod resultant;
pub(crate) mod work;

use dashpot_units::Dimension;
use thiserror::Error;

use self::defects::defects;
use crate::{
    Approach, Cfc, CfcFault, Channel, ChannelFault, Contact, Defect, Measure, Motion, Noise,
    Offset, Padding, Part, Reading, Steps, Uncertainty, Work,
    clipping::{self, Clipping},
    measures::Reader,
    noise::NEAR,
};

/// What is taken off a channel before anything else.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Removal {
    /// Nothing.
    #[default]
    Nothing,
    /// The reading at rest before the pulse.
    Found,
    /// This much, in SI units.
    Given(f64),
}

/// What is done with a channel before it is read.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Settings {
    /// What is taken off.
    pub offset: Removal,
    /// Where it is at rest \[s\], as another axis of its location tells; by default its own pulse does.
    pub rest: Option<(f64, f64)>,
    /// Whether its signs are turned.
    pub is_inverted: bool,
    /// The rate at which it is read off the line between its samples \[Hz\]; as it is by default.
    pub rate: Option<f64>,
    /// The filter; none by default.
    pub cfc: Option<Cfc>,
    /// What stands beyond the ends of the record for the filter.
    pub padding: Padding,
    /// The part that is read, cut behind the filter \[s\].
    pub window: Option<(f64, f64)>,
    /// How a body moves that an accelerometer is on, where its motion is wanted.
    pub approach: Option<Approach>,
    /// How far every sample may be off besides, in SI units.
    pub error: f64,
}

/// Why a channel cannot be read as it is asked for.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum SettingsFault {
    /// An offset that is to be found, and no record before the pulse.
    #[error("there are fewer than eight samples at rest before the pulse: no offset can be found")]
    NoRest,
    /// A filter on uneven steps.
    #[error(
        "its steps are from {} to {} ms long, and a CFC filter wants even ones", 1e3 * .range.0, 1e3 * .range.1
    )]
    UnevenSteps { range: (f64, f64) },
    /// A filter that does not fit.
    #[error(transparent)]
    Cfc(#[from] CfcFault),
    /// A rate at which there are too many samples.
    #[error(transparent)]
    Rate(ChannelFault),
    /// A touch that the record does not hold.
    #[error("the contact is to begin at {touch} s, and the record is from {} to {} s", .span.0, .span.1)]
    NoTouch { touch: f64, span: (f64, f64) },
    /// A window or rate that leaves no signal.
    #[error("nothing is left of it in the window, or at the rate, that is asked for")]
    NothingLeft(#[source] ChannelFault),
}

/// A channel that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Analysis {
    /// The channel as it was recorded; of a resultant as it was read.
    pub raw: Channel,
    /// The same as it was read: without offset, filtered, cut.
    pub channel: Channel,
    /// The stretches \[s\] in which the record is at the end of a range; of a resultant those of its axes.
    pub clipped: Vec<(f64, f64)>,
    /// What it holds of what happens at its place.
    pub part: Part,
    /// Names of channels of its file that may hold more of it, and are no part of this or of a resultant.
    pub beside: Vec<String>,
    /// Steps of the record.
    pub steps: Steps,
    /// The reading at rest, where the record tells it.
    pub offset: Option<Offset>,
    /// Of an acceleration or a force the reading at rest behind the pulse, where nothing is at rest before it and nothing
    /// was taken off, and that is not zero: its zero may be off by as much, which the errors hold.
    pub behind: Option<Offset>,
    /// Of an acceleration or a force, how far below its reading at rest it has sagged at the end of the pulse, in SI units, where
    /// it comes back as behind a high-pass; the errors hold it.
    pub sag: Option<f64>,
    /// What was taken off, in SI units.
    pub removed: Option<f64>,
    /// What was done with it.
    pub settings: Settings,
    /// The stretch about the peak.
    pub contact: Contact,
    /// Its numbers.
    pub readings: Vec<Reading>,
    /// The motion of the body that it is on, where that is wanted and it is an acceleration, or a force and the mass is
    /// known.
    pub motion: Option<Motion>,
    /// The work of a force, where there is a displacement.
    pub work: Option<Work>,
    /// How far its samples may be off.
    pub uncertainty: Uncertainty,
    /// By how much its samples change at most if nothing happened beyond the ends of the record, where a filter smears its
    /// pulse beyond them, in its unit; else 0. The errors of its readings hold what that changes.
    pub beyond: f64,
    /// What is wrong with it.
    pub defects: Vec<Defect>,
}

/// A channel as it is read: without offset, filtered, cut.
#[derive(Debug, Clone, PartialEq)]
pub struct Treated {
    /// The channel.
    pub channel: Channel,
    /// The reading at rest, where the record tells it.
    pub offset: Option<Offset>,
    /// The reading at rest behind the pulse, where the zero may be off by as much.
    pub(crate) behind: Option<Offset>,
    /// How far it has sagged at the end of the pulse, where it sags as behind a high-pass.
    pub(crate) sag: Option<f64>,
    /// What was taken off, in SI units.
    pub removed: Option<f64>,
    /// How far every sample may be off in the same direction: by the error of the offset that was taken off, or all of the
    /// reading at rest that was not, of an acceleration or a force, behind the pulse where nothing rests before; by half a resolution; by what else is stated.
    pub floor: f64,
    /// What it reads at rest; 0 where that is not known.
    pub rest: f64,
    /// The same where nothing happens beyond the ends of the record, as far as its filter smears a pulse there.
    pub(crate) at_rest: Option<Channel>,
}

/// A filter smears a pulse by so many periods of its design frequency.
const SMEARED: f64 = 3.0;
/// What it changes by less than this part of the peak is rounding.
const ROUNDING: f64 = 1e-6;

impl Settings {
    /// What is made of a channel before it is read.
    ///
    /// # Errors
    ///
    /// [`SettingsFault`], where the channel does not allow what is asked for.
    pub fn treated(&self, raw: &Channel) -> Result<Treated, SettingsFault> {
        let offset = match self.rest {
            None => Offset::before_pulse(raw),
            Some(window) => Offset::within(raw, window),
        };
        let removed = match (self.offset, offset) {
            (Removal::Nothing, _) => None,
            (Removal::Given(value), _) => Some(value),
            (Removal::Found, Some(offset)) => Some(offset.value),
            (Removal::Found, None) => return Err(SettingsFault::NoRest),
        };
        let rest = offset.map_or(0.0, |own| own.value - removed.unwrap_or(0.0));
        // A velocity or displacement may stand anywhere before an impact.
        let has_zero = matches!(raw.dimension(), Dimension::ACCELERATION | Dimension::FORCE);
        let behind = (has_zero && offset.is_none() && removed.is_none())
            .then(|| match Offset::behind_pulse(raw) {
                Some(own) => own.is_there().then_some(own),
                None => Offset::at_both_ends(raw),
            })
            .flatten();
        let error = offset.filter(|_| has_zero || self.offset == Removal::Found);
        let error = error.map(|own| rest.abs() + own.error);
        let behind_error = behind.map_or(0.0, |own| own.value.abs() + own.error);
        let error = error.unwrap_or(behind_error);
        let sag = offset.filter(|_| has_zero).and_then(|own| own.sag(raw));
        let floor = error + 0.5 * raw.resolution() + self.error + sag.map_or(0.0, f64::abs);
        let sign = if self.is_inverted { -1.0 } else { 1.0 };
        let (mut channel, mut at_rest) =
            (raw.map(|own| sign * (own - removed.unwrap_or(0.0))), None);
        if let Some(rate) = self.rate {
            channel = channel.resampled(rate).map_err(|fault| match fault {
                ChannelFault::TooMany { .. } => SettingsFault::Rate(fault),
                fault => SettingsFault::NothingLeft(fault),
            })?;
        }
        if let Some(cfc) = self.cfc {
            let steps = channel.steps();
            if !steps.are_even {
                return Err(SettingsFault::UnevenSteps { range: steps.range });
            }
            let values = cfc.filter(channel.values(), steps.rate, self.padding)?;
            let reach = SMEARED / cfc.design_frequency();
            // A velocity may be any beyond the ends.
            let count = (reach * steps.rate).ceil();
            let wider = has_zero.then(|| channel.between_rests(sign * rest, count)).flatten();
            at_rest = match wider {
                Some(own) => {
                    let values = cfc.filter(own.values(), steps.rate, Padding::Hold)?;
                    Some(own.with_values(values))
                }
                None => None,
            };
            channel = channel.with_values(values);
        }
        if let Some(window) = self.window {
            channel = channel.cut(window).map_err(SettingsFault::NothingLeft)?;
            at_rest = at_rest.and_then(|own| own.cut(window).ok());
        }
        Ok(Treated { channel, offset, behind, sag, removed, floor, rest: sign * rest, at_rest })
    }

    /// Reads a channel.
    ///
    /// # Errors
    ///
    /// [`SettingsFault`], where the channel does not allow what is asked for.
    pub fn analyse(&self, raw: Channel) -> Result<Analysis, SettingsFault> {
        let treated = self.treated(&raw)?;
        let (touch, span) = (self.approach.and_then(|own| own.touch), treated.channel.span());
        if let Some(touch) = touch.filter(|own| *own < span.0 || *own > span.1) {
            return Err(SettingsFault::NoTouch { touch, span });
        }
        let noise = Noise::of(&raw, treated.offset.as_ref(), self.cfc);
        let clipped = clipping::stretches(&raw);
        let mut own = self.read(raw, treated, noise, (Part::Whole, clipped));
        own.defects = defects(&own);
        Ok(own)
    }

    /// Reads a channel that was treated, but for its defects.
    pub(crate) fn read(
        &self,
        raw: Channel,
        treated: Treated,
        noise: Noise,
        (part, clipped): (Part, Vec<(f64, f64)>),
    ) -> Analysis {
        let Treated { channel, offset, behind, sag, removed, floor, rest, at_rest } = treated;
        let uncertainty = Uncertainty { floor, rest, noise };
        let seen = (&part, &clipped[..]);
        let (mut readings, motion, contact) = self.readings(&channel, uncertainty, seen);
        let change = at_rest.as_ref().map_or(0.0, |own| channel.apart(own));
        let is_more = change > f64::max(noise.extreme(1), ROUNDING * channel.largest().1);
        // Before a filter the noise of the samples at the ends is larger, and odd ends turn about them.
        let at_ends = || Noise::of(&raw, offset.as_ref(), None).extreme(NEAR);
        let is_open = is_more && change > at_ends();
        if let Some(other) = at_rest.filter(|_| is_more) {
            let others = self.readings(&other, uncertainty, seen).0;
            for (own, other) in readings.iter_mut().zip(others) {
                match own.value.ok().zip(other.value.ok()) {
                    Some((one, other)) => own.error += (one - other).abs(),
                    None if is_open => own.error = f64::INFINITY,
                    None => {}
                }
            }
        }
        Analysis {
            steps: raw.steps(),
            raw,
            channel,
            clipped,
            part,
            beside: Vec::new(),
            offset,
            behind,
            sag,
            removed,
            settings: *self,
            contact,
            readings,
            motion,
            work: None,
            uncertainty,
            beyond: if is_open { change } else { 0.0 },
            defects: Vec::new(),
        }
    }

    /// All that is read off a channel.
    fn readings(
        &self,
        channel: &Channel,
        uncertainty: Uncertainty,
        (part, clipped): (&Part, &[(f64, f64)]),
    ) -> (Vec<Reading>, Option<Motion>, Contact) {
        let clipping = Clipping::of(channel, clipped, self.cfc.is_some());
        let reader = Reader::new(channel, uncertainty, clipping);
        let is_read =
            |own: &Measure| own.is_of_magnitudes() || !matches!(part, Part::Resultant { .. });
        let measures = Measure::of(channel.dimension()).filter(is_read);
        let mut readings: Vec<Reading> = measures.filter_map(|own| reader.read(own)).collect();
        let approach = self.approach.filter(|own| match channel.dimension() {
            Dimension::FORCE => own.mass.is_some(),
            dimension => dimension == Dimension::ACCELERATION,
        });
        let motion = approach.map(|own| reader.motion(own));
        for (motion, approach) in motion.iter().zip(approach) {
            let all = motion.readings(channel, approach).into_iter();
            let motion = (motion, approach.gravity);
            let left = |own| match clipping {
                Some(clipping) => clipping.left(own, Some(motion)),
                None => motion.0.left(own),
            };
            readings.extend(all.map(left));
        }
        (readings, motion, reader.contact())
    }
}

impl Analysis {
    /// The reading of a measure, where it has one.
    pub fn reading(&self, measure: Measure) -> Option<&Reading> {
        self.readings.iter().find(|own| own.measure == measure)
    }

    /// The sampling rate at which it was filtered and read \[Hz\].
    pub fn rate(&self) -> f64 {
        self.settings.rate.unwrap_or(self.steps.rate)
    }
}
