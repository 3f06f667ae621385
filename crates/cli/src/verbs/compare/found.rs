//! What a comparison of two models has found, and its tables. As an object it is in SI units; what is
//! infinite or missing is null.

use dashpot_report::Table;
use dashpot_rheology::{
    Canonical,
    equivalence::{Equivalence, FormComparison, ModePair, Pair, SAME_WITHIN},
    sensitivity::ParameterMap,
};
use serde::Serialize;

use crate::{
    numbers::{apart, bound, quantity},
    output::{VERSION, list},
    verbs::run::measure_text,
};

const DIGITS: usize = 6;

#[derive(Serialize)]
pub(super) struct Comparison {
    pub(super) dashpot: &'static str,
    /// The two, as they were named.
    pub(super) compared: [String; 2],
    /// Whether they are the same.
    pub(super) same: bool,
    /// The relative difference of a rate or strength up to which they are.
    pub(super) within: f64,
    /// The largest relative difference, in the form in which it is smaller.
    pub(super) largest_difference: Option<f64>,
    /// What a constant is measured in: `N/m`, or `Pa` for materials.
    pub(super) unit: &'static str,
    /// Constants of the forms, where both have them.
    pub(super) forms: Vec<Form>,
    /// Where the responses differ most.
    pub(super) worst: Option<Worst>,
    /// About each of the two.
    pub(super) models: Vec<About>,
    /// How the parameters of the second follow from those of the first.
    pub(super) map: Option<Map>,
    /// The same impact with both.
    pub(super) impact: Option<Impact>,
}

/// A canonical form of both.
#[derive(Serialize)]
pub(super) struct Form {
    #[serde(rename = "form")]
    pub(super) word: &'static str,
    pub(super) largest_difference: f64,
    pub(super) constants: Vec<Constant>,
}

/// A constant of a form: a stiffness or a damping.
#[derive(Serialize)]
pub(super) struct Constant {
    part: String,
    time: Option<[f64; 2]>,
    value: [Option<f64>; 2],
    unit: &'static str,
    difference: f64,
}

#[derive(Serialize)]
pub(super) struct Worst {
    pub(super) frequency: Option<f64>,
    pub(super) response: f64,
    /// Of the creep; null with masses that move.
    pub(super) time: Option<f64>,
    pub(super) creep: Option<f64>,
}

/// What is known of one of the two.
#[derive(Serialize)]
pub(super) struct About {
    pub(super) elements: Option<usize>,
    pub(super) least_elements: Option<usize>,
    /// Of a network with moving masses.
    pub(super) poles: Option<usize>,
    pub(super) maxwell_form: bool,
    pub(super) kelvin_form: bool,
    pub(super) cancelled: Vec<Cancelled>,
    pub(super) entangled: Vec<Together>,
}

/// Poles that zeros cancel.
#[derive(Serialize)]
pub(super) struct Cancelled {
    pub(super) pole: [f64; 2],
    pub(super) count: usize,
}

/// Parameters that cannot all be told apart.
#[derive(Serialize)]
pub(super) struct Together {
    pub(super) parameters: Vec<String>,
    pub(super) combinations: Vec<String>,
}

#[derive(Serialize)]
pub(super) struct Map {
    from: Vec<String>,
    to: Vec<String>,
    relative: Vec<Vec<f64>>,
    pub(super) condition: f64,
}

/// Measures of the same impact.
#[derive(Serialize)]
pub(super) struct Impact {
    pub(super) scene: String,
    pub(super) element: String,
    pub(super) method: [&'static str; 2],
    pub(super) measures: Vec<Measured>,
}

/// A measure with each of the two.
#[derive(Serialize)]
pub(super) struct Measured {
    pub(super) measure: String,
    pub(super) unit: &'static str,
    pub(super) value: [Option<f64>; 2],
    pub(super) error: [Option<f64>; 2],
    pub(super) difference: Option<f64>,
}

impl Comparison {
    /// What is known when two linear models have been compared.
    pub(super) fn of(compared: [String; 2], is_material: bool, found: &Equivalence) -> Self {
        let units = if is_material { ["Pa", "Pa s"] } else { ["N/m", "N s/m"] };
        let forms = [(Canonical::Maxwell, &found.maxwell), (Canonical::Kelvin, &found.kelvin)];
        let forms = forms.into_iter().filter_map(|(form, own)| {
            own.as_ref().map(|own| Form {
                word: word(form),
                largest_difference: own.largest,
                constants: constants(form, own, units),
            })
        });
        let forms: Vec<Form> = forms.collect();
        Self {
            dashpot: VERSION,
            compared,
            same: found.is_same,
            within: SAME_WITHIN,
            largest_difference: forms.iter().map(|form| form.largest_difference).reduce(f64::min),
            unit: units[0],
            forms,
            worst: found.worst.map(|worst| Worst {
                frequency: Some(worst.omega / std::f64::consts::TAU),
                response: worst.stiffness,
                time: Some(worst.time),
                creep: Some(worst.creep),
            }),
            models: Vec::new(),
            map: None,
            impact: None,
        }
    }
}

impl Map {
    pub(super) fn of(map: &ParameterMap) -> Self {
        let paths = |own: &[dashpot_rheology::sensitivity::Parameter]| {
            own.iter().map(|own| own.path.clone()).collect()
        };
        Self {
            from: paths(&map.from),
            to: paths(&map.to),
            relative: map.relative.clone(),
            condition: map.condition(),
        }
    }

    /// Whether it has no more parameters than that.
    pub(super) fn is_at_most(&self, most: usize) -> bool {
        self.from.len() <= most && self.to.len() <= most
    }

    /// As a table: percent of the second's parameters for one percent of the first's.
    pub(super) fn table(&self) -> Table {
        let cell =
            |value: &f64| if value.abs() < 5e-5 { "0".to_owned() } else { format!("{value:.4}") };
        let rows = self.to.iter().zip(&self.relative);
        let caption = "Percent of a parameter of the second for one percent of one of the first";
        let header = [""].into_iter().chain(self.from.iter().map(String::as_str));
        let row = |(path, row): (&String, &Vec<f64>)| {
            list([path.clone()].into_iter().chain(row.iter().map(cell)))
        };
        Table::new(caption, header, rows.map(row))
    }
}

fn word(form: Canonical) -> &'static str {
    match form {
        Canonical::Maxwell => "maxwell",
        Canonical::Kelvin => "kelvin",
    }
}

/// The constants of a form as stiffnesses and dampings, those that both lack left out.
fn constants(
    form: Canonical,
    form_comparison: &FormComparison,
    units: [&'static str; 2],
) -> Vec<Constant> {
    let is_kelvin = form == Canonical::Kelvin;
    let value = |own: f64| (own > 0.0).then(|| if is_kelvin { own.recip() } else { own });
    let values = |pair: &Pair| [pair.first, pair.second].map(value);
    let (spring, dashpot) = if is_kelvin {
        (&form_comparison.at_short_times, &form_comparison.at_long_times)
    } else {
        (&form_comparison.at_long_times, &form_comparison.at_short_times)
    };
    let single = |part: &str, pair: &Pair, unit| Constant {
        part: part.to_owned(),
        time: None,
        value: values(pair),
        unit,
        difference: pair.difference,
    };
    let singles = [single("spring", spring, units[0]), single("dashpot", dashpot, units[1])];
    let modes =
        form_comparison.modes.iter().enumerate().map(|(at, ModePair { time, strength })| {
            Constant {
                part: format!("{}-{}", word(form), at + 1),
                time: Some([time.first, time.second]),
                value: values(strength),
                unit: units[0],
                difference: time.difference.max(strength.difference),
            }
        });
    let is_there = |constant: &Constant| constant.value.iter().any(Option::is_some);
    singles.into_iter().filter(is_there).chain(modes).collect()
}

/// The times of two modes, as one where they look the same.
fn times([first, second]: [f64; 2]) -> String {
    let shown = [first, second].map(|own| quantity(own, "s", DIGITS));
    match [first > 0.0, second > 0.0] {
        [true, true] if shown[0] != shown[1] => shown.join(" | "),
        [true, _] => shown[0].clone(),
        _ => shown[1].clone(),
    }
}

impl Form {
    pub(super) fn table(&self) -> Table {
        let caption = if self.word == "kelvin" {
            "Kelvin form: in series"
        } else {
            "Maxwell form: in parallel"
        };
        let rows = self.constants.iter().map(|constant| {
            let time = constant.time.map_or_else(String::new, times);
            let value = |value: Option<f64>| {
                value.map_or_else(|| "none".to_owned(), |it| quantity(it, constant.unit, DIGITS))
            };
            let [first, second] = constant.value.map(value);
            vec![constant.part.clone(), time, first, second, apart(constant.difference)]
        });
        Table::new(caption, &["", "time", "first", "second", "difference"], rows)
    }
}

impl Impact {
    pub(super) fn table(&self) -> Table {
        let rows = self.measures.iter().map(|own| {
            let value = |at: usize| {
                let text = |it: f64| measure_text(&own.measure, it, own.unit, DIGITS);
                own.value[at].map_or_else(|| "–".to_owned(), text)
            };
            let error = own.error.iter().flatten().copied().fold(0.0, f64::max);
            let size = own.value.iter().flatten().fold(0.0_f64, |size, own| size.max(own.abs()));
            let error = if size > 0.0 { bound(error / size) } else { String::new() };
            let difference = own.difference.map_or_else(|| "–".to_owned(), apart);
            vec![own.measure.clone(), value(0), value(1), difference, error]
        });
        let caption = format!("The impact {} with each as its `{}`", self.scene, self.element);
        Table::new(caption, &["", "first", "second", "difference", "known to"], rows)
    }
}
