//! What a comparison of two models has found, and its tables. As an object it is in SI units; what is
//! infinite or missing is null.

use dashpot_report::Table;
use dashpot_rheology::{
    Canonical,
    equivalence::{Equivalence, FormComparison, ModePair, Pair, SAME_WITHIN},
    sensitivity::ParameterMap,
};
use serde::Serialize;

use dashpot_report::numbers::{apart, bound, quantity};

use crate::{VERSION, list, measure_units::measure_text};

const DIGITS: usize = 6;

/// What a comparison of two models has shown; as an object it is in SI units, and what is infinite or missing is null.
#[derive(Debug, Serialize)]
pub struct Comparison {
    /// Version of the program.
    pub dashpot: &'static str,
    /// The two, as they were named.
    pub compared: [String; 2],
    /// Whether they are the same.
    pub same: bool,
    /// The relative difference of a rate or strength up to which they are.
    pub within: f64,
    /// The largest relative difference, in the form in which it is smaller.
    pub largest_difference: Option<f64>,
    /// What a constant is measured in: `N/m`, or `Pa` for materials.
    pub unit: &'static str,
    /// Constants of the forms, where both have them.
    pub forms: Vec<Form>,
    /// Where the responses differ most.
    pub worst: Option<Worst>,
    /// About each of the two.
    pub models: Vec<About>,
    /// How the parameters of the second follow from those of the first.
    pub map: Option<Map>,
    /// The same impact with both.
    pub impact: Option<Impact>,
}

/// A canonical form of both.
#[derive(Debug, Serialize)]
pub struct Form {
    /// `maxwell` or `kelvin`.
    #[serde(rename = "form")]
    pub word: &'static str,
    /// The largest relative difference of a constant \[1\].
    pub largest_difference: f64,
    /// The constants of both.
    pub constants: Vec<Constant>,
}

/// A constant of a form: a stiffness or a damping.
#[derive(Debug, Serialize)]
pub struct Constant {
    part: String,
    time: Option<[f64; 2]>,
    value: [Option<f64>; 2],
    unit: &'static str,
    difference: f64,
}

/// Where the responses differ most.
#[derive(Debug, Serialize)]
pub struct Worst {
    /// Frequency \[Hz\]; 0 or infinite for a limit.
    pub frequency: Option<f64>,
    /// Relative difference of the response there \[1\].
    pub response: f64,
    /// Of the creep; null with masses that move.
    pub time: Option<f64>,
    /// Relative difference of the creep \[1\].
    pub creep: Option<f64>,
}

/// What is known of one of the two.
#[derive(Debug, Serialize)]
pub struct About {
    /// Springs and dashpots of a model.
    pub elements: Option<usize>,
    /// As many as are needed for the same response.
    pub least_elements: Option<usize>,
    /// Of a network with moving masses.
    pub poles: Option<usize>,
    /// Whether it has a Maxwell form.
    pub maxwell_form: bool,
    /// Whether it has a Kelvin form.
    pub kelvin_form: bool,
    /// Poles that zeros cancel.
    pub cancelled: Vec<Cancelled>,
    /// Parameters that cannot all be told apart.
    pub entangled: Vec<Together>,
}

/// Poles that zeros cancel.
#[derive(Debug, Serialize)]
pub struct Cancelled {
    /// Real and imaginary part \[1/s\].
    pub pole: [f64; 2],
    /// How many there are.
    pub count: usize,
}

/// Parameters that cannot all be told apart.
#[derive(Debug, Serialize)]
pub struct Together {
    /// Their paths.
    pub parameters: Vec<String>,
    /// What can be told instead.
    pub combinations: Vec<String>,
}

/// How the parameters of the second follow from those of the first.
#[derive(Debug, Serialize)]
pub struct Map {
    from: Vec<String>,
    to: Vec<String>,
    relative: Vec<Vec<f64>>,
    /// Condition number \[1\].
    pub condition: f64,
}

/// Measures of the same impact.
#[derive(Debug, Serialize)]
pub struct Impact {
    /// The scene.
    pub scene: String,
    /// The element in whose place the models stand.
    pub element: String,
    /// The methods.
    pub method: [&'static str; 2],
    /// The measures.
    pub measures: Vec<Measured>,
}

/// A measure with each of the two.
#[derive(Debug, Serialize)]
pub struct Measured {
    /// Its key.
    pub measure: String,
    /// Its unit.
    pub unit: &'static str,
    /// Its values, in its unit.
    pub value: [Option<f64>; 2],
    /// Their errors, in its unit.
    pub error: [Option<f64>; 2],
    /// Relative difference \[1\].
    pub difference: Option<f64>,
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
