//! Numbers of a scene, fitted to curves that were measured on it.

use std::sync::{Arc, Mutex, PoisonError};

use dashpot_analysis::Solve as _;
use dashpot_fit::{
    network::{Curve, NetworkFault, NetworkFit, NetworkSettings, Number, Test, fit},
    structure::{Undetermined, undetermined},
};
use dashpot_network::Network;
use dashpot_scene::{
    Posed, Scene, Tunables, Variation, pose, read,
    units::{parse_quantity, si_unit},
};

use super::{
    FitArguments,
    asked::{Asked, FLAG},
};
use crate::{
    args::Switch,
    error::CliError,
    input::Input,
    operand::print_notes,
    output::list,
    terminal::{Terminal, note},
    verbs::run::{
        beside::{MeasuredCurve, Output},
        recorded::Recorded,
    },
};

/// Digits of fitted numbers in a scene.
const DIGITS: usize = 5;
/// A number is moved by this part to see what it acts on.
const MOVED: f64 = 1e-3;
/// Tolerance of runs by stepping methods.
const RTOL: f64 = 1e-9;
/// Runs that are kept for each test, because they are asked for again.
const KEPT: usize = 4;

/// A number that was fitted.
pub(super) struct Varied {
    pub(super) name: String,
    /// Its unit in the scene, or that of the command line; empty where it has none.
    pub(super) unit: String,
    /// What one of that is in SI units.
    pub(super) one: f64,
    /// Its SI unit.
    pub(super) si: String,
    pub(super) bounds: [f64; 2],
    at: usize,
}

/// Constants that are determined in the place of numbers that are not.
pub(super) struct Shown {
    pub(super) element: String,
    pub(super) numbers: Vec<String>,
    /// Name, value, and the ends of its interval, each in an SI unit.
    pub(super) constants: Vec<(String, f64, Option<[f64; 2]>, &'static str)>,
}

/// A scene that was fitted.
pub(super) struct FittedScene {
    pub(super) scene: Scene,
    pub(super) numbers: Vec<Varied>,
    pub(super) curves: Vec<(Asked, MeasuredCurve)>,
    pub(super) shown: Vec<Shown>,
    pub(super) fit: NetworkFit,
    tunables: Tunables,
}

/// Fits numbers of a scene.
pub(super) fn fitted(
    arguments: &FitArguments,
    input: &Input,
    terminal: Terminal,
) -> Result<FittedScene, CliError> {
    let set = &arguments.values.set;
    let checked = read(input.text()?, &input.options(set)).map_err(CliError::Scene)?;
    terminal.diagnose(&checked.warnings);
    let scene = checked.value;
    print_notes(&scene.notes);
    let tunables = Tunables::of(&scene.text, Some(&input.file)).map_err(CliError::Scene)?;
    let numbers = numbers(arguments, &tunables)?;
    let read = |own: &Asked| MeasuredCurve::read((FLAG, &own.measured_as()), 0.0, &scene.assembly);
    let curves = arguments.to.iter().map(|own| Ok((own.clone(), read(own)?)));
    let curves = curves.collect::<Result<Vec<_>, CliError>>()?;
    curves.iter().filter_map(|own| own.1.note.as_deref()).for_each(note);
    let tests: Vec<Test> = list(curves.iter().map(|(_, own)| Test {
        rows: own.rows.clone(),
        is_shifted: arguments.shift == Switch::On,
        is_offset: arguments.offset == Switch::On,
    }));
    let solver = Solver {
        input,
        tunables: &tunables,
        numbers: &numbers,
        set: list(curves.iter().map(|own| [&set[..], &own.0.set[..]].concat())),
        outputs: list(curves.iter().map(|own| &own.1.output)),
        kept: list(curves.iter().map(|_| Mutex::default())),
    };
    let begin = |own: &Varied| {
        let [low, high] = own.bounds;
        let start = tunables.all()[own.at].value;
        let is_between = (low..=high).contains(&start);
        Number { low, high, start: if is_between { start } else { (low * high).sqrt() } }
    };
    let begun: Vec<Number> = list(numbers.iter().map(begin));
    let settings = NetworkSettings {
        starts: arguments.starts,
        seed: arguments.seed,
        is_robust: arguments.robust == Switch::On,
    };
    let fit = fit(&begun, &tests, settings, &|test, values| solver.curve(test, values));
    let mut fit = fit.map_err(|fault| wrong(&fault, &curves))?;
    let shown = solver.shown(&fit)?;
    // What no test tells apart has no intervals, whatever rounding makes of them.
    let is_shown = |own: &Varied| shown.iter().any(|other| other.numbers.contains(&own.name));
    let each = numbers.iter().zip(&mut fit.numbers).filter(|own| is_shown(own.0));
    each.for_each(|own| own.1.ends = None);
    Ok(FittedScene { scene, numbers, curves, shown, fit, tunables })
}

fn wrong(fault: &NetworkFault, curves: &[(Asked, MeasuredCurve)]) -> CliError {
    let (text, reason) = match fault {
        NetworkFault::Nothing { test } => {
            (&curves[*test].0.text, "its values are zero throughout".to_owned())
        }
        _ => (&curves[0].0.text, fault.to_string()),
    };
    CliError::Fit { text: text.clone(), reason }
}

/// The numbers that the command line names, with their bounds.
fn numbers(arguments: &FitArguments, tunables: &Tunables) -> Result<Vec<Varied>, CliError> {
    let parsed = arguments.vary.iter().map(|own| Variation::parse(own));
    let mut variations = parsed.collect::<Result<Vec<_>, _>>()?;
    let flag = "--vary";
    let matched = tunables.matched(&mut variations);
    let matched = matched.map_err(|fault| CliError::Tunable { flag, fault })?;
    let varied = variations.iter().zip(matched).map(|(own, at)| {
        let bounds = [own.values[0], own.values[own.len() - 1]];
        let is_range = bounds[0] > 0.0 && bounds[0] < bounds[1];
        if own.is_of_words() || !is_range {
            let reason =
                format!("`{0}` wants bounds above zero, such as \"{0}=10..1000 kN/m\"", own.name);
            return Err(CliError::WrongSetting { name: "--vary".to_owned(), reason });
        }
        let number = &tunables.all()[at];
        let unit = if number.unit.is_empty() { &own.unit } else { &number.unit };
        let one = parse_quantity(&format!("1 {unit}"));
        let one = one.map_or(1.0, |own| number.dimension.map_or(own, |to| own.meant(to)).value);
        let dimension = number.dimension.or(own.dimension);
        let si = dimension.map_or(String::new(), si_unit);
        Ok(Varied { name: own.name.clone(), unit: unit.clone(), one, si, bounds, at })
    });
    varied.collect()
}

/// A run for these numbers.
type Kept = (Vec<f64>, Arc<Recorded>);

/// What solves the scene for given numbers.
struct Solver<'s> {
    input: &'s Input,
    tunables: &'s Tunables,
    numbers: &'s [Varied],
    /// What is set for each test.
    set: Vec<Vec<(String, String)>>,
    outputs: Vec<&'s Output>,
    /// For each test the last runs, with their numbers.
    kept: Vec<Mutex<Vec<Kept>>>,
}

impl Solver<'_> {
    fn posed(&self, set: &[(String, String)], values: &[f64]) -> Result<Posed, String> {
        let each = self.numbers.iter().zip(values);
        let texts = each.map(|(own, value)| (own.at, format!("{value:e} {}", own.si)));
        let texts: Vec<(usize, String)> =
            list(texts.map(|(at, text)| (at, text.trim_end().to_owned())));
        let text = self.tunables.text_with(&texts);
        pose(&text, &self.input.options(set)).map_err(|faults| {
            let messages = faults.list.iter().map(dashpot_scene::Diagnostic::message);
            messages.collect::<Vec<_>>().join("; ")
        })
    }

    fn curve(&self, test: usize, values: &[f64]) -> Result<Box<dyn Curve>, String> {
        let is_it = |own: &&Kept| {
            own.0.iter().zip(values).all(|(one, other)| one.to_bits() == other.to_bits())
        };
        let kept = || self.kept[test].lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(own) = kept().iter().find(is_it) {
            return Ok(Box::new(Shared(Arc::clone(&own.1))));
        }
        let posed = self.posed(&self.set[test], values)?;
        let method = match &posed.run.methods[..] {
            [only] => only,
            _ => "auto",
        };
        let mut settings = posed.settings(method).map_err(|error| error.to_string())?;
        settings.estimate = false;
        // Differences of runs are taken, which exact ones bear anyhow.
        settings.rtol = settings.rtol.or(Some(RTOL));
        settings.measures.clear();
        settings.limits.clear();
        let run = posed.network.solve_with(&settings).map_err(|error| error.to_string())?;
        let output = self.outputs[test];
        let lacks = || format!("`{}` is not kept in this run", output.key());
        let own = Arc::new(Recorded::of(&run, output).ok_or_else(lacks)?);
        let mut kept = kept();
        if kept.len() == KEPT {
            kept.remove(0);
        }
        kept.push((values.to_vec(), Arc::clone(&own)));
        Ok(Box::new(Shared(own)))
    }

    /// What is determined in the place of numbers that are not.
    fn shown(&self, fit: &NetworkFit) -> Result<Vec<Shown>, CliError> {
        let values: Vec<f64> = list(fit.numbers.iter().map(|own| own.value));
        let network = |values: &[f64]| -> Result<Network, CliError> {
            let posed = self.posed(&self.set[0], values);
            let fault = |reason| CliError::Fit { text: "scene".to_owned(), reason };
            posed.map(|own| own.network).map_err(fault)
        };
        let moved = (0..values.len()).map(|at| {
            let mut own = values.clone();
            own[at] *= 1.0 + MOVED;
            network(&own)
        });
        let (base, moved) = (network(&values)?, moved.collect::<Result<Vec<_>, _>>()?);
        Ok(list(
            undetermined(&base, &moved).iter().map(|own| self.constants(own, &base, &moved, fit)),
        ))
    }

    fn constants(
        &self,
        own: &Undetermined,
        base: &Network,
        moved: &[Network],
        fit: &NetworkFit,
    ) -> Shown {
        let values = own.constants(base);
        let beside: Vec<Vec<f64>> = list(moved.iter().map(|other| own.constants(other)));
        let constant = |(at, (name, value)): (usize, (&String, &f64))| {
            // Of the logarithm, by the logarithms of the numbers.
            let gradient: Vec<f64> =
                list(beside.iter().map(|other| (other[at] / value).ln() / MOVED.ln_1p()));
            let ends = fit.interval_of(&gradient).map(|factor| [value / factor, value * factor]);
            let unit = if own.is_spring(base, at) { "N/m" } else { "N s/m" };
            (name.clone(), *value, ends, unit)
        };
        let constants = own.shown.iter().zip(&values).enumerate().map(constant);
        let names = own.numbers.iter().map(|at| self.numbers[*at].name.clone());
        Shown {
            element: own.element.clone(),
            numbers: names.collect(),
            constants: constants.filter(|own| own.1.is_finite()).collect(),
        }
    }
}

/// A record that is asked for again.
struct Shared(Arc<Recorded>);

impl Curve for Shared {
    fn value(&self, time: f64) -> f64 {
        self.0.value(time)
    }

    fn peak(&self) -> (f64, f64) {
        let Recorded { signal, zero, end, .. } = &*self.0;
        let peak = signal.absolute_maximum((0.0, *end));
        let sides = [signal.left_value(peak.time), signal.value(peak.time)];
        let signed = if sides[0].abs() > sides[1].abs() { sides[0] } else { sides[1] };
        (peak.time - zero, peak.value.copysign(signed))
    }
}

impl FittedScene {
    /// The text of the scene with the numbers that were found, below lines on where they are from.
    pub(super) fn scene_text(&self, comments: &[String]) -> String {
        let texts = self.numbers.iter().zip(&self.fit.numbers).map(|(own, found)| {
            let number: f64 =
                format!("{:.*e}", DIGITS - 1, found.value / own.one).parse().unwrap_or(f64::NAN);
            (own.at, format!("{number} {}", own.unit).trim_end().to_owned())
        });
        let text = self.tunables.text_with(&list(texts));
        let lines: Vec<String> = list(comments.iter().map(|own| format!("# {own}\n")));
        lines.concat() + &text
    }
}
