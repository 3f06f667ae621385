//! Tones of texts.

/// What a text is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tone {
    /// A heading.
    Heading,
    /// What the reader must know.
    Warning,
    /// Less important.
    Faint,
    /// The word before an error.
    Error,
    /// The word before a proposal.
    Help,
}

/// How a terminal shows tones.
pub trait Tones {
    /// The text in the style of its tone.
    fn toned(&self, tone: Tone, text: &str) -> String;
}

/// Without any style.
impl Tones for () {
    fn toned(&self, _tone: Tone, text: &str) -> String {
        text.to_owned()
    }
}
