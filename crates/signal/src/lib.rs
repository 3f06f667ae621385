//! Measured channels of impact tests: from samples to numbers that can be signed.
//!
//! A [`Channel`] holds samples of one quantity over time, in SI units. [`Settings::analyse`] takes off an [`Offset`],
//! filters by a channel frequency class ([`Cfc`]), and reads what [`Measure`]s say: peak, HIC, severity index, clips.
//! Between samples a channel is a straight line and windows are continuous; [`Sampling`] says how far the signal
//! itself may be from that line, and every [`Reading`] has the error that follows.
//!
//! Channels that are axes of one location, as a [`Place`] tells, have a resultant: [`Analysis::resultants`].
//!
//! The crate reads no files and prints nothing.

mod analysis;
mod axes;
mod cfc;
mod channel;
mod clipping;
mod impact;
pub mod iso_mme;
mod measures;
mod motion;
mod noise;
mod offset;
mod rating;
mod reading;
mod recorder;
mod repeats;
mod sampling;
mod whitener;

pub use analysis::defects::Defect;
pub use analysis::resultant::Part;
pub use analysis::work::{Work, WorkFault};
pub use analysis::{Analysis, Removal, Settings, SettingsFault, Treated};
pub use axes::{Axis, Label, Place, Places, location_of_resultant};
pub use cfc::{Cfc, CfcFault, Padding};
pub use channel::{Channel, ChannelFault, Steps};
pub use clipping::clipped_rows;
pub use impact::{CONTACT_LEVEL, Contact, Impact};
pub use motion::{Approach, Motion};
pub use noise::{Noise, Uncertainty};
pub use offset::Offset;
pub use rating::{Rating, Unrated};
pub use reading::{Measure, Reading, Reason, Truth};
pub use recorder::Recorder;
pub use repeats::{Band, Repeated};
pub use sampling::Sampling;
pub use whitener::Whitener;

#[cfg(test)]
mod tests;
