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

/// Words for a direction, of x, y and z.
const WORDS: [&[&str]; 3] =
    [&["longitudinal", "foreaft", "längs"], &["lateral", "quer"], &["vertical", "hoch"]];
/// Short ones, which tell a direction where something else is named as well: `Head A-P`, `Head lat`.
const SHORT: [&[&str]; 3] = [&["ap", "pa", "long"], &["lr", "rl", "lat"], &["si", "is", "vert"]];
/// Symbols that a letter of an axis is written behind: `ax`, `accX`, `Fz`.
const SYMBOLS: [&str; 9] = ["a", "acc", "accel", "g", "f", "v", "d", "s", "u"];
/// Words that say no place.
const FILLERS: [&str; 8] =
    ["axis", "achse", "dir", "direction", "value", "wert", "channel", "kanal"];
/// Words of what is a resultant by itself.
const RESULTANTS: [&str; 5] = ["resultant", "resultante", "resultierende", "res", "magnitude"];

/// What tells where a channel is.
#[derive(Debug, Clone, Copy)]
pub struct Label<'n> {
    /// Its name.
    pub name: &'n str,
    /// Its code of ISO-MME.
    pub code: Option<&'n ChannelCode>,
    /// Whether it was given that name to say where it is: then it is no axis of anything else.
    pub is_declared: bool,
}

impl Label<'_> {
    /// Whether it says all that there is to know of its place.
    fn is_sure(&self) -> bool {
        let is_code = self.code.is_some_and(|own| own.location().is_some()) || is_code(self.name);
        let is_resultant = |own: &&str| RESULTANTS.contains(&&*own.to_lowercase());
        self.is_declared || is_code || tokens(self.name).iter().any(is_resultant)
    }
}

/// Where the channels of one file are that measure the same quantity.
#[derive(Debug, Clone)]
pub struct Places {
    all: Vec<Option<Place>>,
    /// Those of which nothing tells whether they are axes of what others measure.
    are_unknown: Vec<bool>,
}

impl Places {
    /// Those that codes, or else names tell. What may be an axis, as `X` alone or the end of `HEADX`, is one where another
    /// name differs by its axis alone.
    pub fn of(labels: &[Label<'_>]) -> Self {
        let of_one = |own: &Label<'_>| match own.code.filter(|code| code.direction().is_some()) {
            Some(code) => Some((Place::of_code(code)?, true)),
            None => Place::of_name(own.name),
        };
        let mut found: Vec<Option<(Place, bool)>> = labels.iter().map(of_one).collect();
        Place::number(&mut found, labels);
        let is_beside = |own: &Place| {
            found.iter().flatten().any(|other| own.is_beside(&other.0) && own.axis != other.0.axis)
        };
        let is_one = |own: &&(Place, bool)| own.1 || is_beside(&own.0);
        let all: Vec<Option<Place>> =
            found.iter().map(|own| own.as_ref().filter(is_one).map(|own| own.0.clone())).collect();
        let unknown = labels.iter().zip(&all).map(|(own, place)| place.is_none() && !own.is_sure());
        Self { are_unknown: unknown.collect(), all }
    }

    /// The place of a channel that is one axis.
    pub fn get(&self, at: usize) -> Option<&Place> {
        self.all.get(at)?.as_ref()
    }

    /// Channels that may be further axes of the body that one is on: the other axes of its location, and where not all
    /// three are there, or of what is no known axis itself, those of which nothing is known.
    pub fn beside(&self, at: usize) -> Vec<usize> {
        let is_whole = |place: &Place| {
            let is_there = |axis| {
                self.all.iter().flatten().any(|own| own.is_beside(place) && own.axis == axis)
            };
            Axis::ALL.into_iter().all(is_there)
        };
        let is_further = |other: &usize| match (self.get(at), self.get(*other)) {
            (Some(own), Some(other)) => own.is_beside(other) && own.axis != other.axis,
            (Some(own), None) => self.are_unknown[*other] && !is_whole(own),
            (None, Some(other)) => self.are_unknown[at] && !is_whole(other),
            (None, None) => self.are_unknown[at] && self.are_unknown[*other] && at != *other,
        };
        (0..self.all.len()).filter(is_further).collect()
    }
}

/// The location of a channel that by its name or code is a resultant which was recorded: `Head` of `Head res`.
pub fn location_of_resultant(name: &str) -> Option<String> {
    let code = ChannelCode::new(name);
    if is_code(name) && code.direction() == Some('R') {
        return code.location().map(str::to_owned);
    }
    let is_word = |own: &&str| RESULTANTS.contains(&&*own.to_lowercase());
    let word = tokens(name).into_iter().find(is_word)?;
    let (before, behind) = name.split_once(word)?;
    let is_apart = |own: char| !own.is_alphanumeric();
    let parts = [before, behind].map(|own| own.trim_matches(is_apart));
    Some(parts.into_iter().filter(|own| !own.is_empty()).collect::<Vec<_>>().join(" "))
}

impl Place {
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

    /// Sets places of names that end in a number: of several sensors at one location each has a number, and axes of its
    /// own; a number that one axis alone has tells it from another sensor of that axis.
    fn number(found: &mut [Option<(Self, bool)>], labels: &[Label<'_>]) {
        let split = |label: &Label<'_>| {
            let bare = label.name.trim_end_matches(|own: char| own.is_ascii_digit());
            let number = label.name[bare.len()..].to_owned();
            let has_code = label.code.is_some_and(|own| own.direction().is_some());
            let is_one = !(number.is_empty() || has_code || is_code(label.name));
            Some((Self::of_name(bare).filter(|_| is_one)?, number))
        };
        let all: Vec<_> = labels.iter().map(split).collect();
        for (place, own) in found.iter_mut().zip(&all) {
            let Some(((bare, is_sure), number)) = own else { continue };
            let is_triad = all.iter().flatten().any(|((other, _), of)| {
                of == number && bare.is_beside(other) && bare.axis != other.axis
            });
            *place = Some((if is_triad { bare.numbered(number) } else { bare.clone() }, *is_sure));
        }
    }

    /// The same of the sensor of this number.
    fn numbered(&self, number: &str) -> Self {
        let location = format!("{} {number}", self.location).trim_start().to_owned();
        let resultant = format!("{location} resultant");
        Self { resultant, location, key: format!("{}\n{number}", self.key), ..self.clone() }
    }

    /// That of a name, and whether it is one for certain.
    fn of_name(name: &str) -> Option<(Self, bool)> {
        if let Some(own) = Self::of_code(&ChannelCode::new(name)).filter(|_| is_code(name)) {
            return Some((own, true));
        }
        let tokens = tokens(name);
        let last = tokens.len().checked_sub(1)?;
        let start = |at: usize| tokens[at].as_ptr() as usize - name.as_ptr() as usize;
        let end = |at: usize| start(at) + tokens[at].len();
        // A direction is one part, or two as `A-P`.
        let (first, until, axis, symbol) = (0..=last).rev().find_map(|at| {
            let pair =
                (at < last).then(|| Some((at, at + 1, pair_axis(tokens[at], tokens[at + 1])?, "")));
            let one = || axis_of(tokens[at], at == last).map(|own| (at, at, own.0, own.1));
            pair.flatten().or_else(one)
        })?;
        let is_named = tokens.iter().enumerate().any(|(other, own)| {
            !(first..=until).contains(&other) && !FILLERS.contains(&&*own.to_lowercase())
        });
        let is_symbol = SYMBOLS.contains(&&*symbol.to_lowercase());
        // A symbol that is not known is the name of the place: `HEAD` of `HEADX`.
        let kept = if is_symbol && is_named { 0 } else { symbol.len() };
        let is_apart = |own: char| !own.is_alphanumeric();
        let before = name[..start(first) + kept].trim_end_matches(is_apart);
        let behind = name[end(until)..].trim_matches(is_apart);
        let rest = [before, behind].into_iter().filter(|own| !own.is_empty()).collect::<Vec<_>>();
        let rest = rest.join(" ");
        let is_short =
            tokens[first].len() == 1 || SHORT.concat().contains(&&*tokens[first].to_lowercase());
        let is_sure = is_symbol || symbol.is_empty() && is_named && is_short;
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

/// The axis that two parts of a name tell together: `A-P`, `fore-aft`.
fn pair_axis(one: &str, other: &str) -> Option<Axis> {
    let both = [one, other].concat().to_lowercase();
    let is_one = |at: usize| [WORDS[at], SHORT[at]].concat().contains(&&*both);
    Axis::ALL.into_iter().enumerate().find(|own| is_one(own.0)).map(|own| own.1)
}

/// The axis that a part of a name tells, and the symbol before its letter. The last part may end in a letter of an axis
/// whatever stands before it.
fn axis_of(token: &str, is_last: bool) -> Option<(Axis, &str)> {
    if let Some(axis) = pair_axis(token, "") {
        return Some((axis, ""));
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
        let all = places(names).all.into_iter();
        all.map(|own| own.map(|own| (own.location, own.axis))).collect()
    }

    fn places(names: &[&str]) -> Places {
        let label = |name| Label { name, code: None, is_declared: false };
        Places::of(&names.iter().copied().map(label).collect::<Vec<_>>())
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
            (["Head A-P", "Head L-R", "Head S-I"], "Head"),
            (["AP [raw]", "LR [raw]", "SI [raw]"], "raw"),
            (["HeadLong", "HeadLat", "HeadVert"], "Head"),
            (["fore-aft", "lat", "vert"], ""),
            (["head1x", "head1y", "head1z"], "head1"),
            (["A17.x", "A17.y", "A17.z"], "A17"),
            (["11HEAD0000H3ACXA", "11HEAD0000H3ACYA", "11HEAD0000H3ACZA"], "HEAD"),
        ] {
            let expected = Axis::ALL.map(|axis| Some((location.to_owned(), axis)));
            assert_eq!(told(&names), expected, "{names:?}");
        }
    }

    #[test]
    fn what_is_not_told_apart_may_be_axes_of_one_body() {
        for (names, beside) in [
            (&["acc1", "acc2"][..], &[&[1][..], &[0]][..]),
            (&["Head", "Chest", "F"], &[&[1, 2], &[0, 2], &[0, 1]]),
            (&["Kopf"], &[&[]]),
            // A resultant that was recorded is no axis, and nothing is one beside three.
            (&["Head X", "Head Y", "Head Z", "Head res"], &[&[1, 2], &[0, 2], &[0, 1], &[]]),
            (&["Head X", "Head Y", "Head Z", "acc"], &[&[1, 2], &[0, 2], &[0, 1], &[]]),
            (&["Head X", "acc"], &[&[1], &[0]]),
            (&["Head X", "Chest X"], &[&[], &[]]),
            (&["11HEAD0000H3ACRA", "11CHST0000H3AC0A"], &[&[], &[]]),
        ] {
            let all = places(names);
            let found: Vec<_> = (0..names.len()).map(|at| all.beside(at)).collect();
            assert_eq!(found, beside, "{names:?}");
        }
        let label = |name, is_declared| Label { name, code: None, is_declared };
        assert!(Places::of(&[label("a1", true), label("a2", false)]).beside(0).is_empty());
    }

    #[test]
    fn a_name_alone_is_an_axis_only_where_it_says_so() {
        for (name, is_one) in [
            ("Head X", true),
            ("HeadZ", true),
            ("az", true),
            ("acc z", true),
            ("Head A-P", true),
            ("Head lat", true),
            ("AP", false),
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
