//! Clip: what is exceeded for a given time, and for 3 ms.

use std::sync::Arc;

use dashpot_network::{parameters, parameters::WindowWish};

use super::{
    Family, Measure, MeasureKind, Needs, Reading, WINDOW,
    exceedance::{Counted, Exceedance},
};
use crate::{Note, Solution};

parameters! {
    /// The largest acceleration that is reached or exceeded for a given time: the largest `A` \[m/s²\]
    /// with `|a| ≥ A` for at least the `duration`, where `a` is what an accelerometer on the body reads.
    ///
    /// | symbol | field      | unit | range    |
    /// |--------|------------|------|----------|
    /// | `d`    | `duration` | s    | positive |
    /// |        | `counted`  |      | [`Counted`] |
    ///
    /// Times are counted `together` (all of them are added up) or `at-once` (within one stretch). It is 0
    /// where the whole window is shorter than the duration. Where the speed jumps it is not infinite,
    /// because a jump takes no time.
    ///
    /// A half-sine of height `A` and length `T` has `A cos(π d/(2 T))`, counted either way; of two equal
    /// ones apart from each other the times count together as those of one of twice the length.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Clip: "clip", "largest acceleration that is exceeded for a given time [m/s^2]" {
        /// the time d [s], positive
        pub duration: f64 = Quantity(Dimension::TIME), default "3 ms", range Positive;
        /// `together`: all times are added up; `at-once`: those of one stretch
        pub counted: Counted = Choice(Counted::WORDS), default "together";
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
    default { duration: 0.003, counted: Counted::Together, window: WindowWish::Impact }
}

impl MeasureKind for Clip {
    const UNIT: &'static str = "m/s^2";
    const APPLIES_TO: Family = Family::Node;
    const NEEDS: Needs = Needs::Acceleration;

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let acceleration = solution.node_acceleration(target)?;
        let span = solution.node_span(target, self.window)?;
        let found = Exceedance::new(acceleration, span.window()).level(self.duration, self.counted);
        // Values move by the error of the signal, and a longer window moves the level no faster than
        // the signal itself.
        let end_rate = if found.reaches_end { found.slope } else { 0.0 };
        let error = acceleration.error.zip(span.to_error);
        let error =
            error.map(|(error, shift)| error + if shift > 0.0 { end_rate * shift } else { 0.0 });
        let reading = Reading::over(&span, found.value, error).of_size(found.value);
        let reading = reading.above(acceleration.noise).changing(end_rate);
        Ok(reading.noting_if(span.length() < self.duration, Note::WindowTooShort))
    }
}

parameters! {
    /// The largest acceleration that is reached or exceeded for 3 ms \[m/s²\]; otherwise as [`Clip`].
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct Clip3ms: "clip-3ms", "largest acceleration that is exceeded for 3 ms [m/s^2]" {
        /// Which times count.
        pub counted: Counted => Clip::PARAMETERS[1];
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
}

impl Clip3ms {
    fn clip(self) -> Clip {
        Clip { duration: 0.003, counted: self.counted, window: self.window }
    }
}

impl MeasureKind for Clip3ms {
    const UNIT: &'static str = "m/s^2";
    const APPLIES_TO: Family = Family::Node;
    const NEEDS: Needs = Needs::Acceleration;

    fn general(&self) -> Option<Arc<dyn Measure>> {
        Some(Arc::new(self.clip()))
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        MeasureKind::read(&self.clip(), solution, target)
    }
}
