//! Scenes: a network and what is to be done with it.

use std::sync::Arc;

use dashpot_analysis::{Accuracy, Choice, Limit, MeasureWish, RunError, SolveSettings};
use dashpot_network::{Assembly, Network, effects::EFFECTS, parameters::registered};
use dashpot_units::Quantity;

pub use crate::sections::RunSettings;
use crate::{
    check::{
        constant_area::constant_areas,
        elastic::elastic_pads,
        network_faults::{note_errors, note_held, note_warnings},
        review::{outlasted, resting_impactors, review, upward, weightless},
    },
    diagnostics::{Checked, Diagnostic, Diagnostics, Faults, fault::Fault},
    kinds::{Example, model_words},
    models::{ModelReader, notes::ModelNote},
    quantities::{
        bare::BareNumbers,
        values::{NamedValue, Overrides},
    },
    sections::{
        Reading, Targets, check_stops, find_duration, read_accuracy, read_effects, read_elements,
        read_limits, read_loads, read_measures, read_nodes, read_run,
    },
    text::{
        bytes::{table_for_scene, text_of_bytes},
        document::{Entry, Item, parse},
        library::{Library, Loader},
        source::{Place, Source, set_source},
        table::{text_of, unknown_key},
    },
    vary::{scattered::ScatteredNumber, set::Settled, together, tunable::TunableFault},
};

/// The sections of a scene and of a file of models.
const SECTIONS: [&str; 15] = [
    "title",
    "values",
    "models",
    "materials",
    "nodes",
    "elements",
    "effects",
    "loads",
    "measures",
    "limits",
    "accuracy",
    "run",
    "fit",
    "design",
    together::SECTION,
];

/// What a text without a file is called.
const UNNAMED: &str = "scene";

/// The comment by which a text says that its numbers without a unit are meant in SI units, as programs write them.
const BARE_ARE_SI: &str = "#:units SI";

/// Everything that a scene says, checked.
#[derive(Debug, Clone)]
pub struct Scene {
    /// What it is, in the author's words.
    pub title: Option<String>,
    /// Path of the file that it was read from.
    pub file: Option<String>,
    /// Nodes, elements, loads and effects.
    pub network: Network,
    /// The network compiled for [`RunSettings::duration`].
    pub assembly: Arc<Assembly>,
    /// How it is to be run.
    pub run: RunSettings,
    /// How accurate the measures are to be.
    pub accuracy: Accuracy,
    /// What is to be reported besides what every run reports.
    pub measures: Vec<MeasureWish>,
    /// What the measures may be.
    pub limits: Vec<Limit>,
    /// What is odd about its text.
    pub warnings: Vec<Diagnostic>,
    /// What is to be said about its models, besides warnings.
    pub notes: Vec<ModelNote>,
    /// Its numbers with scatter, which are read as their means.
    pub scatter: Vec<ScatteredNumber>,
    /// Named values, those set from outside included, by name.
    pub values: Vec<NamedValue>,
    /// The text.
    pub text: Arc<str>,
    /// Paths of the other files of which it is made, as they were asked of the [`Loader`].
    pub files: Vec<String>,
}

impl Scene {
    /// What is to be asked of a run by the method of this name; `auto` chooses.
    ///
    /// # Errors
    ///
    /// [`RunError::UnknownMethod`].
    pub fn settings(&self, method: &str) -> Result<SolveSettings, RunError> {
        asked(&self.run, &self.accuracy, (&self.measures, &self.limits), method)
    }

    /// Adds limits to its own, and to its notes what is to be said about elements that they are on.
    pub fn add_limits(&mut self, limits: impl IntoIterator<Item = Limit>) {
        Limit::add(&mut self.limits, limits);
        let elastic = elastic_pads(&self.network, &self.limits, &self.measures);
        for note in constant_areas(&self.network, &self.limits).into_iter().chain(elastic) {
            if !self.notes.contains(&note) {
                self.notes.push(note);
            }
        }
    }
}

/// What a scene asks of a run by the method of this name.
pub(crate) fn asked(
    run: &RunSettings,
    accuracy: &Accuracy,
    (measures, limits): (&[MeasureWish], &[Limit]),
    method: &str,
) -> Result<SolveSettings, RunError> {
    Ok(SolveSettings {
        method: Choice::named(method)?,
        duration: run.duration,
        is_duration_found: run.at_most.is_some(),
        rtol: run.rtol,
        accuracy: accuracy.clone(),
        estimate: true,
        stops: run.stops.clone(),
        budget: SolveSettings::BUDGET,
        measures: measures.to_vec(),
        limits: limits.to_vec(),
    })
}

/// How a text is to be read.
#[derive(Clone, Copy, Default)]
pub struct ReadOptions<'o> {
    /// Path of the file, for messages and for finding others beside it.
    pub file: Option<&'o str>,
    /// What overrides the text: a name under `[values]`, or the path of a number or a word such as
    /// `head.mass` or `liner.material`, and what stands there then.
    pub set: &'o [(String, String)],
    /// Gives the bytes of other files, for `model = "pads.toml:valox-pad"` and `table = "pulse.csv"`.
    pub loader: Option<Loader<'o>>,
    /// What becomes of numbers without a unit.
    pub bare: BareNumbers,
}

impl std::fmt::Debug for ReadOptions<'_> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let loader = self.loader.map(|_| "…");
        formatter
            .debug_struct("ReadOptions")
            .field("file", &self.file)
            .field("set", &self.set)
            .field("loader", &loader)
            .finish()
    }
}

/// Reads a scene.
///
/// # Examples
///
/// ```
/// use dashpot_scene::{ReadOptions, reference, read};
///
/// let scene = read(reference(), &ReadOptions::default())?.value;
/// assert_eq!(scene.network.connections()[0].name, "padding");
/// assert_eq!(scene.run.duration, 0.02);
///
/// let faults = read("[run]\nduration = \"20 mm\"", &ReadOptions::default()).unwrap_err();
/// assert!(faults.render(false).contains("`20 mm` is a length (m); a time (s) is expected here"));
/// # Ok::<(), dashpot_scene::Diagnostics>(())
/// ```
///
/// # Errors
///
/// All faults of the text, each with its place.
pub fn read(text: &str, options: &ReadOptions<'_>) -> Result<Checked<Scene>, Diagnostics> {
    read_of(&text, options)
}

/// Reads a scene from a text that it keeps, and shares.
///
/// # Errors
///
/// As those of [`read`].
pub fn read_shared(
    text: &Arc<str>,
    options: &ReadOptions<'_>,
) -> Result<Checked<Scene>, Diagnostics> {
    read_of(text, options)
}

fn read_of<T: Text>(text: &T, options: &ReadOptions<'_>) -> Result<Checked<Scene>, Diagnostics> {
    let of = |size| checked(options.bare, |faults| read_scene(text.clone(), options, size, faults));
    let large = (text.as_ref().len() > LARGE).then(|| of(TextSize::Large)).and_then(Result::ok);
    let mut read = large.map_or_else(|| of(TextSize::Usual), Ok)?;
    read.value.warnings.clone_from(&read.warnings.list);
    Ok(read)
}

/// Reads a scene from the bytes of a file.
///
/// # Errors
///
/// All faults of the text, each with its place; bytes that are not UTF-8.
pub fn read_bytes(bytes: &[u8], options: &ReadOptions<'_>) -> Result<Checked<Scene>, Diagnostics> {
    read(text_of_bytes(bytes, options.file)?, options)
}

/// Reads the network of a text; `[run]` may be missing, and the network need not compile.
///
/// It is meant for networks that are looked at from outside, at one of their nodes. All that the
/// text says besides is checked as in a scene.
///
/// # Errors
///
/// All faults of the text, each with its place.
pub fn read_network(
    text: &str,
    options: &ReadOptions<'_>,
) -> Result<Checked<Network>, Diagnostics> {
    checked(options.bare, |faults| {
        let (library, _) = load(text, options, faults)?;
        let parts = Parts::read(&library, faults);
        if library.section("run").is_some() {
            read_run(&parts.reading);
        }
        Some(parts.network)
    })
}

/// What `read` returns, unless it notes an error.
pub(crate) fn checked<T>(
    bare: BareNumbers,
    read: impl FnOnce(&Faults) -> Option<T>,
) -> Result<Checked<T>, Diagnostics> {
    let faults = Faults::with(bare);
    let value = read(&faults);
    faults.tell_bare();
    let errors = faults.errors();
    let found = faults.finish();
    match value {
        Some(value) if errors == 0 => Ok(Checked { value, warnings: found }),
        _ => Err(found),
    }
}

/// A text that is copied to be kept, or shared.
pub(crate) trait Text: AsRef<str> + Into<Arc<str>> + Clone {}

impl<T: AsRef<str> + Into<Arc<str>> + Clone> Text for T {}

/// The documents of a text.
pub(crate) fn load(
    text: impl Text,
    options: &ReadOptions<'_>,
    faults: &Faults,
) -> Option<(Library, Arc<Source>)> {
    let name = options.file.unwrap_or(UNNAMED);
    let (settled, set) = Settled::in_text(text.as_ref(), options.set);
    let settled = (settled != text.as_ref()).then(|| settled.into_owned());
    let source = Arc::new(match settled {
        Some(settled) => Source::new(format!("{name}, as set"), settled),
        None => Source::new(name, text),
    });
    let settled = &source.text;
    if let Some(fault) = table_for_scene(settled, name) {
        faults.error(Place::new(faults.add_source(Arc::clone(&source)), &(0..0)), fault);
        return None;
    }
    let root = parse(&source, faults)?;
    let library = library_of((root, settled), set, options, faults);
    Some((library, source))
}

/// The documents of a text that is parsed, and what is set besides.
pub(crate) fn library_of(
    (root, text): (Item, &str),
    set: Settled,
    options: &ReadOptions<'_>,
    faults: &Faults,
) -> Library {
    if text.lines().any(|line| line.trim_end() == BARE_ARE_SI) {
        faults.allow_bare();
    }
    for (own, fault) in set.astray {
        let place = Place::new(faults.add_source(set_source(&own)), &(0..own.0.len()));
        let help = fault.help();
        faults.error(place, astray_fault(own.0, fault).with_any_help(help));
    }
    let overrides = Overrides::new(&set.named, faults);
    let name = options.file.unwrap_or(UNNAMED);
    Library::load(name, root, options.loader, &overrides, faults)
}

/// What is wrong with the path of something that is set.
fn astray_fault(name: String, fault: TunableFault) -> Fault {
    match fault {
        TunableFault::Ambiguous { names, .. } => Fault::AmbiguousPath { name, names },
        TunableFault::Unknown { ref known, is_left_out, .. } => {
            let help = if is_left_out { fault.help() } else { None };
            let known = known.clone();
            Fault::UnknownName { family: "number or word", name, known }.with_any_help(help)
        }
        TunableFault::NoUnit(bare) => Fault::BareNumber(bare),
        _ => Fault::UnknownName { family: "number or word", name, known: Vec::new() },
    }
}

/// Where a key belongs that stands at the top of a scene.
fn home_of(key: &str) -> Option<String> {
    if let Some(entry) = registered(EFFECTS, key) {
        let path =
            if entry.about.is_per_element { format!("{key}.ELEMENT") } else { key.to_owned() };
        let value = Example::PLAIN.value(entry.parameters);
        return Some(format!("write it under [effects]: `{path} = {value}`"));
    }
    if model_words().contains(&key) {
        return Some(format!("write [elements.name] with `between` and `{key}`"));
    }
    match key {
        "force" | "forces" | "load" => Some("write [loads.name] with `on` and `force`".to_owned()),
        "mass" | "velocity" | "drop" | "energy" | "position" | "motion" => {
            Some(format!("write [nodes.name] with `{key}`"))
        }
        "duration" | "samples" | "rtol" | "stop" | "method" => {
            Some("write it under [run]".to_owned())
        }
        _ => None,
    }
}

/// What a scene and a network have in common.
pub(crate) struct Parts<'d> {
    pub(crate) reading: Reading<'d>,
    pub(crate) network: Network,
    title: Option<String>,
    pub(crate) measures: Vec<MeasureWish>,
    pub(crate) limits: Vec<Limit>,
    pub(crate) accuracy: Accuracy,
    notes: Vec<ModelNote>,
}

impl<'d> Parts<'d> {
    pub(crate) fn read(library: &'d Library, faults: &'d Faults) -> Self {
        let is_stranger =
            |entry: &&Entry| !SECTIONS.contains(&entry.key.as_str()) && !faults.damaged();
        for entry in library.sections().iter().filter(is_stranger) {
            let fault = unknown_key(entry, "the scene", SECTIONS.to_vec());
            faults.error(entry.key_place, fault.with_any_help(home_of(&entry.key)));
        }
        let title = library.section("title");
        let title = title.and_then(|entry| text_of(&entry.item, "`title`", faults));
        let title = title.map(str::to_owned);
        let models = ModelReader::new(library, faults);
        let mut reading = Reading::new(library, faults);
        let mut network = Network::new();
        read_nodes(&mut reading, &mut network);
        read_elements(&mut reading, &models, &mut network);
        read_effects(&reading, &mut network);
        read_loads(&reading, &mut network);
        let targets = Targets::new(&reading, &network);
        let measures = read_measures(&reading, &targets, &models);
        models.check_unused();
        let limits = read_limits(&reading, &targets);
        let accuracy = read_accuracy(&reading, &targets);
        Self { reading, network, title, measures, limits, accuracy, notes: models.notes() }
    }
}

/// Texts longer than this \[B\] are large.
const LARGE: usize = 4 << 20;

/// What becomes of the entries of a text, which take some five times its memory, while its network is compiled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum TextSize {
    /// They say where something is that the compiler finds.
    Usual,
    /// They are gone; there is no scene where anything is to be said or sought then.
    Large,
}

fn read_scene(
    text: impl Text,
    options: &ReadOptions<'_>,
    size: TextSize,
    faults: &Faults,
) -> Option<Scene> {
    let (library, source) = load(text, options, faults)?;
    let Parts { reading, network, title, measures, limits, accuracy, mut notes } =
        Parts::read(&library, faults);
    let (mut run, stops) = read_run(&reading);
    if faults.errors() == 0 {
        together::check(&source, faults);
    }
    let is_large = size == TextSize::Large;
    if faults.errors() > 0 || is_large && (run.at_most.is_some() || !stops.is_empty()) {
        return None;
    }
    let compiled = |duration: f64| {
        let compiled = network.compile(duration);
        compiled.map_err(|errors| note_errors(&reading, &errors)).ok()
    };
    if let Some(at_most) = run.at_most {
        run.stops = check_stops(&reading, &stops, &compiled(0.0)?);
        if faults.errors() > 0 {
            return None;
        }
        run.duration = find_duration(&reading, &network, &run, at_most)?;
    }
    // What is odd about a scene is of no interest while it has no answer.
    let early = if is_large { None } else { Some(compiled(run.duration)?) };
    review(&reading, &network, run.duration);
    outlasted(&reading, &notes, run.duration);
    notes.extend(weightless(&network));
    notes.extend(resting_impactors(&network));
    notes.extend(upward(&network));
    notes.extend(library.table_notes());
    let values = library.values().iter().filter_map(|(name, known)| {
        let Quantity { value, dimension, .. } = known.quantity?;
        let text = known.definition.as_ref()?.text.trim().to_owned();
        Some(NamedValue { name: name.clone(), value, dimension, text })
    });
    let mut values: Vec<NamedValue> = values.collect();
    values.sort_by(|a, b| a.name.cmp(&b.name));
    let scatter = ScatteredNumber::all(&source.text, options.file).unwrap_or_default();
    let files = library.paths();
    let assembly = if let Some(assembly) = early {
        note_held(&reading, &assembly.held);
        note_warnings(&reading, &assembly.warnings);
        if run.at_most.is_none() {
            run.stops = check_stops(&reading, &stops, &assembly);
        }
        assembly
    } else {
        drop(reading);
        drop(library);
        let assembly = network.compile(run.duration).ok()?;
        (assembly.warnings.is_empty() && assembly.held.is_empty()).then_some(assembly)?
    };
    let mut scene = Scene {
        title,
        file: options.file.map(str::to_owned),
        network,
        assembly: Arc::new(assembly),
        run,
        accuracy,
        measures,
        limits: Vec::new(),
        warnings: Vec::new(),
        notes,
        scatter,
        values,
        text: Arc::clone(&source.text),
        files,
    };
    scene.add_limits(limits);
    Some(scene)
}
