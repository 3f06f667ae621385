//! What is to be said about a measure, as data.

use thiserror::Error;

use crate::wording::quantity;

dashpot_units::words! {
    /// What is to be said about a measure.
    #[derive(Debug, Clone, PartialEq, Error)]
    pub enum Note, fn kind(&self) {
        /// The impact has no end within the run.
        #[error("still in contact at the end of the run")]
        StillInContact = "still-in-contact",
        /// The contact force pulls from the start, so there is no impact.
        #[error("the contact force pulls from the start")]
        PullsFromTheStart = "pulls-from-the-start",
        /// There is no contact force.
        #[error("there is never a contact force")]
        NeverLoaded = "never-loaded",
        /// The window lies outside the run.
        #[error("the window lies outside the run")]
        OutsideTheRun = "outside-the-run",
        /// The run ends within the window.
        #[error("the run ends before the window does")]
        RunEndsBefore = "run-ends-before",
        /// The window has no length.
        #[error("the window has no length")]
        NoLength = "no-length",
        /// The window is shorter than the time that counts.
        #[error("the window is shorter than the time that counts")]
        WindowTooShort = "window-too-short",
        /// The node has no mass, or is held fixed.
        #[error("the node has no mass, or is held fixed")]
        Massless = "massless",
        /// The thickness of the element is not known.
        #[error("its thickness is not known: give it a `thickness` or `layers`")]
        NoThickness = "no-thickness",
        /// The area of the element is not known.
        #[error("its area is not known: give it `thickness` and `area`, or `layers`")]
        NoArea = "no-area",
        /// The force is that of a rigid link in a loop of rigid links.
        #[error("the force is undetermined in a loop of rigid links")]
        NoForce = "no-force",
        /// The velocity is not a function of time.
        #[error("the velocity of this massless node jumps with the loads' rates")]
        NoVelocity = "no-velocity",
        /// There is no node of this name.
        #[error("there is no node `{0}`")]
        NoNode(String) = "no-node",
        /// The node of this name is not accelerated.
        #[error("`{0}` is not accelerated")]
        NotAccelerated(String) = "not-accelerated",
        /// The element touches no impactor.
        #[error("it touches no impactor")]
        NoImpactor = "no-impactor",
        /// The ends of the element meet without speed.
        #[error("the ends meet without speed")]
        NoApproach = "no-approach",
        /// Masses meet and part at once.
        #[error("masses meet and part at once")]
        PartsAtOnce = "parts-at-once",
        /// The model is not linear, or cannot deform.
        #[error("its model is not linear, or cannot deform")]
        NotLinear = "not-linear",
        /// The model is too stiff for so long a run.
        #[error("its model is too stiff for so long a run")]
        TooStiff = "too-stiff",
        /// The value rises until its window ends.
        #[error("still rising at the end of its window")]
        StillRising = "still-rising",
        /// The peak is one in tension.
        #[error("in tension")]
        InTension = "in-tension",
        /// The peak is one in elongation.
        #[error("in elongation")]
        InElongation = "in-elongation",
        /// It occurs in this layer, and so deep below the first face \[m\].
        #[error("in the layer {0}, {depth} below the first face", depth = quantity(*.1, "m"))]
        InLayer(String, f64) = "in-layer",
        /// It occurs in the branch of this path.
        #[error("in {0}")]
        InBranch(String) = "in-branch",
        /// A part would have to be thinner than nothing.
        #[error("pressed in by more than its thickness")]
        Crushed = "crushed",
        /// It is infinite, because speeds jump at this time \[s\].
        #[error("infinite (speed jumps at {})", quantity(*.0, "s"))]
        Infinite(f64) = "infinite",
        /// The value is beyond the range of double precision.
        #[error("beyond the range of double precision")]
        BeyondRange = "beyond-range",
        /// It has a value at some tolerances only.
        #[error("it has a value at some tolerances only")]
        ComesAndGoes = "comes-and-goes",
        /// The signal changes its sign, and of its magnitude the value would be this, in the unit of the measure.
        #[error("it swings back, which takes from this: of its magnitude {}", quantity(*.0, "s").trim_end_matches(" s"))]
        LargerByMagnitude(f64) = "larger-by-magnitude",
        /// Not determined: it hangs on what is not followed.
        #[error("not determined: it hangs on what is not followed")]
        NotFollowed = "not-followed",
        /// Not determined: its error, in this unit, would be this.
        #[error("not determined: its error would be {}", quantity(*.0, .1))]
        LargeError(f64, &'static str) = "large-error",
        /// Not determined: the force of a slider is so from one time to another \[s\].
        #[error("not determined: the force of a slider is so from {} to {}", quantity(*.0, "s"), quantity(*.1, "s"))]
        IdleSlider(f64, f64) = "idle-slider",
        /// What a measure of one's own has to say.
        #[error("{text}")]
        Other {
            /// In one word that stays the same.
            code: &'static str,
            /// In words.
            text: String,
        } = "other",
    }
}

impl Note {
    /// What kind of note it is, in one word that stays the same.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Other { code, .. } => code,
            own => own.kind(),
        }
    }

    /// Whether it says where a value occurs, or which way it points.
    pub fn is_place(&self) -> bool {
        matches!(self, Self::InTension | Self::InElongation | Self::InLayer(..) | Self::InBranch(_))
    }

    /// Several ones in words.
    pub fn joined(notes: &[Self]) -> String {
        notes.iter().map(Self::to_string).collect::<Vec<_>>().join("; ")
    }
}
