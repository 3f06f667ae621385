//! Which channels are axes of one location, as their names or codes tell.

use crate::iso_mme::ChannelCode;

/// An axis of a sensor or body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[expect(missing_docs, reason = "the names are all there is to say")]
pub enum Axis {
    X,
    Y,
    Z,
}

impl Axis {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// Its letter, in lower case.
    pub fn letter(self) -> char {
        match self {
            Self::X => 'x',
            Self::Y => 'y',
            Self::Z => 'z',
        }
    }

    /// That of a letter in either case.
    pub fn of(letter: char) -> Option<Self> {
        Self::ALL.into_iter().find(|own| own.letter() == letter.to_ascii_lowercase())
    }
}

/// Where a channel is measured that is one axis of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// What its axes have in common: `Head` of `Head X`, `Head ax` and `HeadX`; nothing of `ax`.
    pub location: String,
    /// The axis.
    pub axis: Axis,
    /// What the resultant of its axes is called: `Head resultant`; the code with `R` as direction, of ISO-MME.
    pub resultant: String,
    /// What tells its location and quantity from others, in lower case.
    key: String,
    /// The filter class in a code of ISO-MME.
    pub(crate) class: Option<char>,
}

/// Words for a direction that stand alone in a name.
const WORDS: [(&str, Axis); 6] = [
    ("longitudinal", Axis::X),
    ("lateral", Axis::Y),
    ("vertical", Axis::Z),
    ("längs", Axis::X),
    ("quer", Axis::Y),
    ("hoch", Axis::Z),
];
/// Symbols that a letter of an axis is written behind: `ax`, `accX`, `Fz`.
const SYMBOLS: [&str; 9] = ["a", "acc", "accel", "g", "f", "v", "d", "s", "u"];
/// Words that say no place.
const FILLERS: [&str; 8] =
    ["axis", "achse", "dir", "direction", "value", "wert", "channel", "kanal"];

impl Place {
    /// The places of the channels of one file that measure the same quantity, by their codes, or else their names. What
    /// may be an axis, as `X` alone or the end of `HEADX`, is one where another name differs by its axis alone.
    pub fn of_channels(all: &[(&str, Option<&ChannelCode>)]) -> Vec<Option<Self>> {
        let names: Vec<&str> = all.iter().map(|own| own.0).collect();
        let of_code = |own: &ChannelCode| own.direction().and(Some(Self::of_code(own)));
        let codes = all.iter().map(|own| own.1.and_then(of_code));
        codes.zip(Self::of_names(&names)).map(|(code, name)| code.unwrap_or(name)).collect()
    }

    fn of_names(names: &[&str]) -> Vec<Option<Self>> {
        let found: Vec<Option<(Self, bool)>> = names.iter().map(|own| Self::of_name(own)).collect();
        let is_beside = |own: &Self| {
            found.iter().flatten().any(|other| own.is_beside(&other.0) && own.axis != other.0.axis)
        };
        let is_one = |own: &&(Self, bool)| own.1 || is_beside(&own.0);
        found.iter().map(|own| own.as_ref().filter(is_one).map(|own| own.0.clone())).collect()
    }

    /// Whether both are at the same location and measure the same, each along its axis.
    pub fn is_beside(&self, other: &Self) -> bool {
        self.key == other.key
    }

    /// That of a code of ISO-MME, whose direction is X, Y or Z.
    fn of_code(code: &ChannelCode) -> Option<Self> {
        let axis = Axis::of(code.direction()?)?;
        let text = code.text();
        let (before, class) = (text.get(..14)?, text.get(15..)?);
        Some(Self {
            location: code.location()?.to_owned(),
            axis,
            resultant: format!("{before}R{class}"),
            key: before.to_lowercase(),
            class: class.chars().next(),
        })
    }

    /// That of a name, and whether it is one for certain.
    fn of_name(name: &str) -> Option<(Self, bool)> {
        if let Some(own) = Self::of_code(&ChannelCode::new(name)).filter(|_| is_code(name)) {
            return Some((own, true));
        }
        let tokens = tokens(name);
        let (at, (axis, symbol)) = tokens
            .iter()
            .enumerate()
            .rev()
            .find_map(|(at, own)| Some((at, axis_of(own, at + 1 == tokens.len())?)))?;
        let is_named = tokens
            .iter()
            .enumerate()
            .any(|(other, own)| other != at && !FILLERS.contains(&&*own.to_lowercase()));
        let is_symbol = SYMBOLS.contains(&&*symbol.to_lowercase());
        // A symbol that is not known is the name of the place: `HEAD` of `HEADX`.
        let kept = if is_symbol && is_named { 0 } else { symbol.len() };
        let start = tokens[at].as_ptr() as usize - name.as_ptr() as usize;
        let is_apart = |own: char| !own.is_alphanumeric();
        let before = name[..start + kept].trim_end_matches(is_apart);
        let behind = name[start + tokens[at].len()..].trim_matches(is_apart);
        let rest = [before, behind].into_iter().filter(|own| !own.is_empty()).collect::<Vec<_>>();
        let rest = rest.join(" ");
        let is_sure = is_symbol || symbol.is_empty() && is_named && tokens[at].len() == 1;
        let location = if is_named || kept > 0 { rest.clone() } else { String::new() };
        let resultant = [&*location, "resultant"].join(" ").trim_start_matches(is_apart).to_owned();
        let key = format!("{rest}\n{symbol}").to_lowercase();
        Some((Self { location, axis, resultant, key, class: None }, is_sure))
    }
}

/// Whether a name is a code: its quantity is two capitals, and nothing in it is a blank.
fn is_code(name: &str) -> bool {
    let is_part = |own: char| own.is_ascii_uppercase() || own.is_ascii_digit() || own == '?';
    name.len() == 16 && name.chars().all(is_part)
}

/// The axis that a part of a name tells, and the symbol before its letter. The last part may end in a letter of an axis
/// whatever stands before it.
fn axis_of(token: &str, is_last: bool) -> Option<(Axis, &str)> {
    let lower = token.to_lowercase();
    if let Some(word) = WORDS.iter().find(|own| own.0 == lower) {
        return Some((word.1, ""));
    }
    let (at, letter) = token.char_indices().next_back()?;
    let symbol = &token[..at];
    let is_known = symbol.is_empty() || SYMBOLS.contains(&&*symbol.to_lowercase());
    (is_known || is_last).then_some((Axis::of(letter)?, symbol))
}

/// The parts of a name: what is no letter or digit stands between them, or a capital begins one, or a letter behind digits.
fn tokens(name: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    for part in name.split(|own: char| !own.is_alphanumeric()).filter(|own| !own.is_empty()) {
        let pairs = part.char_indices().zip(part.char_indices().skip(1));
        let begins = pairs.filter(|((_, one), (_, next))| {
            one.is_lowercase() && next.is_uppercase() || one.is_numeric() && next.is_alphabetic()
        });
        let mut from = 0;
        for to in begins.map(|own| own.1.0).chain([part.len()]) {
            tokens.push(&part[from..to]);
            from = to;
        }
    }
    tokens
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(names: &[&str]) -> Vec<Option<(String, Axis)>> {
        let all = Place::of_names(names).into_iter();
        all.map(|own| own.map(|own| (own.location, own.axis))).collect()
    }

    #[test]
    fn names_tell_location_and_axis() {
        for (names, location) in [
            (["Head ax", "Head ay", "Head az"], "Head"),
            (["HeadX", "HeadY", "HeadZ"], "Head"),
            (["HEADX", "HEADY", "HEADZ"], "HEAD"),
            (["acc_x", "acc_y", "acc_z"], "acc"),
            (["ax", "ay", "az"], "a"),
            (["x", "y", "z"], ""),
            (["X-Axis", "Y-Axis", "Z-Axis"], ""),
            (["Kopf Beschl. X", "Kopf Beschl. Y", "Kopf Beschl. Z"], "Kopf Beschl"),
            (["X Accel", "Y Accel", "Z Accel"], "Accel"),
            (
                ["Head_Acc_X_filtered", "Head_Acc_Y_filtered", "Head_Acc_Z_filtered"],
                "Head_Acc filtered",
            ),
            (["Head longitudinal", "Head lateral", "Head vertical"], "Head"),
            (["head1x", "head1y", "head1z"], "head1"),
            (["A17.x", "A17.y", "A17.z"], "A17"),
            (["11HEAD0000H3ACXA", "11HEAD0000H3ACYA", "11HEAD0000H3ACZA"], "HEAD"),
        ] {
            let expected = Axis::ALL.map(|axis| Some((location.to_owned(), axis)));
            assert_eq!(told(&names), expected, "{names:?}");
        }
    }

    #[test]
    fn a_name_alone_is_an_axis_only_where_it_says_so() {
        for (name, is_one) in [
            ("Head X", true),
            ("HeadZ", true),
            ("az", true),
            ("acc z", true),
            ("11HEAD0000H3ACXA", true),
            ("11HEAD0000H3ACRA", false),
            ("x", false),
            ("Y", false),
            ("Y value", false),
            ("HEADX", false),
            ("Kopf", false),
            ("acc", false),
            ("max", false),
            ("vertical", false),
            ("resultant", false),
            ("Sensor 3", false),
        ] {
            assert_eq!(told(&[name])[0].is_some(), is_one, "{name}");
        }
        // Names that differ in more than their axis are no axes of one another.
        assert_eq!(told(&["HEADX", "CHESTY"]), [None, None]);
        assert_eq!(told(&["left headx", "left heady"])[1], Some(("left head".to_owned(), Axis::Y)));
        let beside = |one, other| {
            let [one, other] = [one, other].map(|own| Place::of_name(own).unwrap().0);
            one.is_beside(&other)
        };
        assert!(beside("Head ax", "head az") && !beside("Head ax", "Chest az"));
        assert!(!beside("Head ax", "Head gz"));
        assert!(beside("11HEAD0000H3ACXA", "11HEAD0000H3ACZC"));
    }
}
