//! Codes of channels, such as `11HEAD0000H3ACXA`.

/// A code of 16 characters: test object, position, main location (4), fine locations (3 of 2), physical dimension (2),
/// direction, filter class.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ChannelCode {
    text: String,
}

impl ChannelCode {
    /// A code as it is written.
    pub(crate) fn new(text: &str) -> Self {
        Self { text: text.to_owned() }
    }

    /// The code.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Where it was measured: `HEAD`; `None` where the code is not of 16 characters.
    pub fn location(&self) -> Option<&str> {
        self.part(2, 6)
    }

    /// The letter of the direction: `X`, `Y` or `Z` of an axis, `R` of a resultant.
    pub fn direction(&self) -> Option<char> {
        self.part(14, 15)?.chars().next()
    }

    /// The channel frequency class that it went through: none for `0`, the class for `A` to `D`.
    pub fn filter_class(&self) -> Option<f64> {
        match self.part(15, 16)? {
            "A" => Some(1000.0),
            "B" => Some(600.0),
            "C" => Some(180.0),
            "D" => Some(60.0),
            _ => None,
        }
    }

    fn part(&self, from: usize, to: usize) -> Option<&str> {
        if self.text.chars().count() == 16 { self.text.get(from..to) } else { None }
    }
}
