//! A law is the same at whichever reference it is given.

use dashpot::{
    analysis::{RunReport, Solve, SolveSettings},
    network::elements::ELEMENTS,
    scene::{ReadOptions, read},
};

/// A law with a reference, as a key of a model for each reference that is asked for.
struct Referred {
    kind: &'static str,
    /// Names and values of its parameters.
    values: Vec<(&'static str, f64)>,
}

impl Referred {
    fn get(&self, name: &str) -> f64 {
        self.values.iter().find(|value| value.0 == name).unwrap().1
    }

    fn with(&self, name: &str, value: f64) -> Self {
        let changed =
            |&(own, old): &(&'static str, f64)| (own, if own == name { value } else { old });
        Self { kind: self.kind, values: self.values.iter().map(changed).collect() }
    }

    /// The same law with a reference that is larger by a factor, and the force that it has there.
    fn at(&self, factor: f64) -> String {
        let force = self.get("force") * factor.powf(self.get("exponent"));
        let same = self.with("at", self.get("at") * factor).with("force", force);
        let values = same.values.iter().map(|(name, value)| format!("{name} = {value:e}"));
        format!("{} = {{ {} }}", self.kind, values.collect::<Vec<_>>().join(", "))
    }
}

/// Every kind of the register that has a reference, with exponents by which forces at references that are
/// powers of two apart are numbers without rounding.
fn referred() -> Vec<Referred> {
    let mut kinds = Vec::new();
    for kind in ELEMENTS {
        let names = kind.parameters.iter().map(|parameter| parameter.name);
        if !names.clone().any(|name| name == "at") {
            continue;
        }
        let values = (kind.sample)();
        let numbers = values.iter().map(|value| value.number().unwrap());
        let own = Referred { kind: kind.word, values: names.zip(numbers).collect() };
        let exponents: &[f64] =
            if kind.word == "power-dashpot" { &[0.5, 3.0] } else { &[1.5, 2.0] };
        kinds.extend(exponents.iter().map(|&exponent| own.with("exponent", exponent)));
    }
    let mut names: Vec<&str> = kinds.iter().map(|kind| kind.kind).collect();
    names.dedup();
    assert_eq!(names, ["power-spring", "rate-spring", "power-dashpot", "hunt-crossley", "bumper"]);
    kinds
}

/// The law alone under a head that strikes it, and before and behind others.
fn scenes(law: &str) -> [String; 4] {
    let spring = "{ spring = 400000 }";
    let kelvin = "{ kelvin-voigt = { spring = 300000, dashpot = 40 } }";
    let pads = [
        law.to_owned(),
        format!("series = [{{ {law} }}, {spring}]"),
        format!("series = [{kelvin}, {{ {law} }}]"),
        format!("parallel = [{spring}, {{ {law} }}]"),
    ];
    pads.map(|pad| {
        format!(
            "[nodes]\nhead = {{ mass = 2, velocity = 1.5 }}\n[elements]\n\
             pad = {{ between = [\"head\", \"ground\"], {pad} }}\n[effects]\n\
             gravity = {{ start = \"unloaded\" }}\n[measures]\n\
             head = [\"end-velocity\", \"end-position\"]\n[run]\nduration = 0.02\n"
        )
    })
}

fn run(text: &str, method: &str) -> Result<RunReport, String> {
    let scene = read(text, &ReadOptions::default()).map_err(|own| own.to_string())?.value;
    let settings = SolveSettings { rtol: Some(1e-6), ..scene.settings(method).unwrap() };
    scene.network.solve_with(&settings).map_err(|own| own.to_string())
}

/// All values and errors of a report.
type Number<'a> = (&'a str, Option<f64>, f64);

fn numbers(report: &Result<RunReport, String>) -> Result<Vec<Number<'_>>, &String> {
    let report = report.as_ref()?;
    let numbers = report.measures.iter();
    let numbers =
        numbers.map(|number| (number.key.as_str(), number.value, number.error.unwrap_or(0.0)));
    Ok(numbers.collect())
}

#[test]
fn laws_at_references_that_are_powers_of_two_apart_give_the_same_numbers_to_the_bit() {
    for law in referred() {
        for (at, text) in scenes(&law.at(1.0)).iter().enumerate() {
            // Steps of low order are many where a law has a kink.
            let methods: &[&str] =
                if law.kind == "rate-spring" { &["bdf"] } else { &["bdf", "esdirk34"] };
            for &method in methods {
                let first = run(text, method);
                for shift in [-20, 20] {
                    let other = &scenes(&law.at(f64::from(shift).exp2()))[at];
                    let second = run(other, method);
                    let [one, two] = [&first, &second].map(|own| format!("{:?}", numbers(own)));
                    assert_eq!(one, two, "{method}\n{text}\n{other}");
                }
                assert!(first.is_ok(), "{method}: {first:?}\n{text}");
            }
        }
    }
}

#[test]
fn laws_at_references_that_are_powers_of_ten_apart_give_the_same_numbers_within_their_bars() {
    for law in referred() {
        for (at, text) in scenes(&law.at(1.0)).iter().enumerate() {
            let first = run(text, "bdf");
            for factor in [1e-6, 1e6] {
                let other = &scenes(&law.at(factor))[at];
                let second = run(other, "bdf");
                let pairs = numbers(&first).unwrap().into_iter().zip(numbers(&second).unwrap());
                for ((key, one, bar), (_, two, its)) in pairs {
                    let off = one.zip(two).map_or(0.0, |(one, two)| (one - two).abs());
                    let rounding = 1e-12 * one.unwrap_or(0.0).abs();
                    assert_eq!(one.is_some(), two.is_some(), "{key}\n{text}\n{other}");
                    assert!(off <= bar + its + rounding, "{key}: {one:?} {two:?} ± {bar}\n{other}");
                }
            }
        }
    }
}
