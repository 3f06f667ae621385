//! The register of limits that standards and rules state.

use dashpot_network::parameters::Kind;

use super::{Bound, Limit};
use crate::measures::{
    Hic, Hic15, Hic36, PeakAcceleration, PeakForce, STANDARD_GRAVITY, TransmittedForce,
};

/// What a standard allows in a test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standard {
    /// Word for it in scenes and on the command line.
    pub word: &'static str,
    /// The standard or rule with its edition.
    pub edition: &'static str,
    /// What is tested, and how.
    pub test: &'static str,
    /// Kinds of measures that it may be a limit on.
    pub kinds: &'static [&'static str],
    /// What is allowed at most, in SI units, and whether that is for the mean of several tests.
    pub bounds: &'static [(f64, bool)],
    /// Radius of the dome \[m\] on which the pad lies, so that the area that is loaded grows; `None` where there is
    /// none, or it is not known.
    pub dome: Option<f64>,
    /// What the numbers were read from.
    pub source: &'static str,
}

const ACCELERATION: &[&str] = &[<PeakAcceleration as Kind>::KIND];
/// On a rigid support the force that is transmitted is that of the pad.
const FORCE: &[&str] = &[<TransmittedForce as Kind>::KIND, <PeakForce as Kind>::KIND];

/// Every standard. **A new one is registered here.**
pub const STANDARDS: &[Standard] = &[
    Standard {
        word: "en-1078",
        edition: "EN 1078:2012",
        test: "helmets for cyclists and skaters: flat anvil at 5.42 to 5.52 m/s, kerbstone anvil with 53.9 J at 5 kg",
        kinds: ACCELERATION,
        bounds: &[(250.0 * STANDARD_GRAVITY, false)],
        dome: None,
        source: "pages of manufacturers and test laboratories",
    },
    Standard {
        word: "en-1080",
        edition: "EN 1080",
        test: "helmets for young children: as EN 1078; which edition the pages are about is not known",
        kinds: ACCELERATION,
        bounds: &[(250.0 * STANDARD_GRAVITY, false)],
        dome: None,
        source: "pages of manufacturers and test laboratories",
    },
    Standard {
        word: "cpsc-1203",
        edition: "16 CFR 1203.12(d)",
        test: "bicycle helmets in the USA: flat anvil at 6.2 m/s, hemispherical and kerbstone anvils at 4.8 m/s",
        kinds: ACCELERATION,
        bounds: &[(300.0 * STANDARD_GRAVITY, false)],
        dome: None,
        source: "text of the rule",
    },
    Standard {
        word: "fmvss-218",
        edition: "FMVSS 218 (49 CFR 571.218)",
        test: "motorcycle helmets in the USA: headforms of 3.5, 5.0 and 6.1 kg; its limits on the time above 150 and 200 g are not part of this one",
        kinds: ACCELERATION,
        bounds: &[(400.0 * STANDARD_GRAVITY, false)],
        dome: None,
        source: "text of the rule",
    },
    Standard {
        word: "fmvss-208-hic15",
        edition: "FMVSS 208 (49 CFR 571.208)",
        test: "occupants in frontal crashes",
        kinds: &[<Hic15 as Kind>::KIND],
        bounds: &[(700.0, false)],
        dome: None,
        source: "text of the rule",
    },
    Standard {
        word: "fmvss-208-hic36",
        edition: "FMVSS 208 (49 CFR 571.208)",
        test: "occupants in frontal crashes",
        kinds: &[<Hic36 as Kind>::KIND],
        bounds: &[(1000.0, false)],
        dome: None,
        source: "text of the rule",
    },
    Standard {
        word: "en-1177",
        edition: "EN 1177:2018+A1:2023",
        test: "surfaces of playgrounds: missile of 4.6 kg from rising heights; the critical one is where the HIC, over \
               any interval, reaches the limit",
        kinds: &[<Hic as Kind>::KIND],
        bounds: &[(1000.0, false)],
        dome: None,
        source: "secondary pages",
    },
    Standard {
        word: "en-1621-1-level-1",
        edition: "EN 1621-1:2012, level 1",
        test: "limb protectors for motorcyclists: 5 kg with 50 J, striker of 40 x 30 mm on a dome of 50 mm",
        kinds: FORCE,
        bounds: &[(35e3, true), (50e3, false)],
        dome: Some(0.05),
        source: "satra.com and two other laboratories",
    },
    Standard {
        word: "en-1621-1-level-2",
        edition: "EN 1621-1:2012, level 2",
        test: "limb protectors for motorcyclists: 5 kg with 50 J, striker of 40 x 30 mm on a dome of 50 mm; only the mean \
               is known here, the standard limits single values as well",
        kinds: FORCE,
        bounds: &[(20e3, true)],
        dome: Some(0.05),
        source: "satra.com and two other laboratories",
    },
    Standard {
        word: "en-1621-2-level-1",
        edition: "EN 1621-2:2014, level 1",
        test: "back protectors for motorcyclists: 5 kg with 50 J",
        kinds: FORCE,
        bounds: &[(18e3, true), (24e3, false)],
        dome: None,
        source: "satra.com and another laboratory",
    },
    Standard {
        word: "en-1621-2-level-2",
        edition: "EN 1621-2:2014, level 2",
        test: "back protectors for motorcyclists: 5 kg with 50 J; only the mean is known here, the standard limits single \
               values as well",
        kinds: FORCE,
        bounds: &[(9e3, true)],
        dome: None,
        source: "satra.com and another laboratory",
    },
];

/// The standard of this word.
pub fn standard(word: &str) -> Option<&'static Standard> {
    STANDARDS.iter().find(|own| own.word == word)
}

impl Standard {
    /// Its limits on the measure with this key; `None` where it is none on measures of that kind.
    pub fn on(&self, key: &str) -> Option<Vec<Limit>> {
        let (_, kind) = key.rsplit_once('.')?;
        self.kinds.contains(&kind).then_some(())?;
        let limit = |&(most, of_mean): &(f64, bool)| Limit {
            from: Some(self.edition.to_owned()),
            of_mean,
            ..Limit::new(key, Bound::Max(most))
        };
        Some(self.bounds.iter().map(limit).collect())
    }
}

#[cfg(test)]
mod tests {
    use dashpot_network::parameters::registered;

    use super::*;
    use crate::measures::MEASURES;

    #[test]
    fn words_are_unique_and_kinds_are_known() {
        for (at, own) in STANDARDS.iter().enumerate() {
            assert!(STANDARDS[..at].iter().all(|other| other.word != own.word), "{}", own.word);
            assert!(own.kinds.iter().all(|kind| registered(MEASURES, kind).is_some()));
            assert!(own.bounds.iter().all(|bound| bound.0 > 0.0));
            assert!(!own.source.is_empty());
        }
    }

    #[test]
    fn a_standard_is_a_limit_on_its_own_kinds_alone() {
        let own = standard("en-1621-1-level-1").unwrap();
        let limits = own.on("pad.transmitted-force").unwrap();
        let told: Vec<_> = limits.iter().map(|own| (own.bound, own.of_mean)).collect();
        assert_eq!(told, [(Bound::Max(35e3), true), (Bound::Max(50e3), false)]);
        assert_eq!(own.on("head.peak-acceleration"), None);
    }
}
