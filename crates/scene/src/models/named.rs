//! Models by their names, as in `pads.toml:felt`.

use std::ops::Range;

use dashpot_network::Model;

use super::{
    ModelReader,
    notes::{ModelNote, Remark},
};
use crate::{
    diagnostics::{Checked, Diagnostic, Diagnostics, Faults, fault::Fault},
    quantities::bare::BareNumbers,
    scene::{ReadOptions, checked, load},
    sections::ELEMENT_KEYS,
    text::{
        document::{Content, Entry, Item, value_of},
        library::{
            Library,
            models::{MODEL_SECTIONS, ModelSection},
        },
        source::Source,
    },
    vary::scattered::ScatteredNumber,
};

/// A two-terminal model that a text gives a name.
#[derive(Debug, Clone)]
pub struct NamedModel {
    /// Its name.
    pub name: String,
    /// The model. That of a material has the values of a pad of 1 m² that is 1 m thick: its
    /// stiffnesses in N/m are the moduli in Pa.
    pub model: Model,
    /// Where it stands: `models`, `materials` or `elements`.
    pub section: &'static str,
    /// Whether it is a material.
    pub is_material: bool,
    /// What is to be said about it.
    pub notes: Vec<ModelNote>,
    /// The bytes of the whole lines of the text on which it stands, from its header or key to its last value.
    pub span: Range<usize>,
}

/// Where a name leads.
enum Found<'d> {
    Model(crate::text::library::models::Reference),
    Element(&'d Entry),
}

impl Found<'_> {
    fn is_material(&self) -> bool {
        matches!(self, Self::Model(own) if own.section == ModelSection::Materials)
    }
}

/// Reads the model that `name` means in a text: one of `[models]`, else of `[materials]`, else that of one of
/// `[elements]`. `models.felt`, `materials.felt` and `elements.felt` tell models of one name apart.
///
/// Without a name it is the only model or material, else the model of the only element. What the
/// text says besides is not looked at: it may be a scene, or a file of models alone.
///
/// The model may hold elements that are not linear. Whoever wants its
/// [linear model](dashpot_network::linear_model) asks
/// [`first_nonlinear`](dashpot_network::first_nonlinear) before.
///
/// # Examples
///
/// ```
/// use dashpot_scene::{ReadOptions, read_named_model};
///
/// let text = "[materials]\nfoam = { kelvin = { spring = \"2 MPa\", dashpot = \"5 kPa s\" } }\n";
/// let foam = read_named_model(text, "foam", &ReadOptions::default())?.value;
/// assert!(foam.is_material);
/// assert_eq!(read_named_model(text, "", &ReadOptions::default())?.value.name, "foam");
///
/// let faults = read_named_model(text, "faom", &ReadOptions::default()).unwrap_err();
/// assert!(faults.render(false).contains("did you mean `foam`?"));
/// # Ok::<(), dashpot_scene::Diagnostics>(())
/// ```
///
/// # Errors
///
/// All faults of the model, each with its place; a name that the text does not have; no name where
/// there are several models.
pub fn read_named_model(
    text: &str,
    name: &str,
    options: &ReadOptions<'_>,
) -> Result<Checked<NamedModel>, Diagnostics> {
    checked(options.bare, |faults| {
        let (library, source) = load(text, options, faults)?;
        let models = ModelReader::new(&library, faults);
        let (found, is_shared) = located(&library, name, faults)?;
        let (entry, model) = read_found(&library, &models, &found, faults)?;
        let is_material = found.is_material();
        let (name, mut notes, span) =
            (entry.key.to_string(), models.notes(), lines_of(&source, entry));
        notes.extend(library.table_notes());
        notes.extend(means(&source.text, entry));
        if is_shared {
            let subject = match found {
                Found::Model(reference) => format!("{} `{name}`", reference.section.word()),
                Found::Element(_) => format!("element `{name}`"),
            };
            notes.push(ModelNote { subject, what: Remark::SharedName(name.clone()), until: None });
        }
        let section = match found {
            Found::Model(reference) => reference.section.key(),
            Found::Element(_) => "elements",
        };
        Some(NamedModel { name, model, section, is_material, notes, span })
    })
}

/// The model of this name in documents, and whether it is a material.
pub(crate) fn model_in(library: &Library, name: &str, faults: &Faults) -> Option<(Model, bool)> {
    let models = ModelReader::new(library, faults);
    let (found, _) = located(library, name, faults)?;
    Some((read_found(library, &models, &found, faults)?.1, found.is_material()))
}

/// Where a name leads, and whether models of several sections have it.
fn located<'d>(library: &'d Library, name: &str, faults: &Faults) -> Option<(Found<'d>, bool)> {
    find(library, name).map_err(|fault| faults.missing(None, fault)).ok()
}

/// What stands there.
fn read_found<'d>(
    library: &'d Library,
    models: &ModelReader<'d>,
    found: &Found<'d>,
    faults: &Faults,
) -> Option<(&'d Entry, Model)> {
    let entry = match found {
        Found::Model(reference) => {
            return Some((library.entry(*reference), models.named(*reference)?));
        }
        Found::Element(entry) => *entry,
    };
    let owner = format!("element `{}`", entry.key);
    if let Some(layers) = value_of(entry, "layers") {
        let message = format!("{owner} is made of layers with mass, which no model has");
        faults.error(layers.place, Fault::odd(message, "ask for one of its materials"));
        return None;
    }
    Some((entry, models.element(&entry.item, owner, entry.key_place, ELEMENT_KEYS)?.model))
}

/// The sections of a text that has models and no scene.
const OF_MODELS: [&str; 4] = ["title", "values", "models", "materials"];

/// Reads all models and materials of a text that has them and nothing else, as [`read_named_model`] does; `None` where
/// it has more, so that it is to be read as a scene, or none.
pub fn read_models(
    text: &str,
    options: &ReadOptions<'_>,
) -> Option<Result<Checked<Vec<NamedModel>>, Diagnostics>> {
    let names = checked(BareNumbers::Silent, |faults| {
        let (library, _) = load(text, options, faults)?;
        let is_alone = library.sections().iter().all(|own| OF_MODELS.contains(&&*own.key));
        let of = |own: ModelSection| {
            let key = own.key();
            library.names(0, own).into_iter().map(move |name| format!("{key}.{name}"))
        };
        Some(MODEL_SECTIONS.into_iter().flat_map(of).filter(|_| is_alone).collect::<Vec<_>>())
    });
    let names = names.ok().map(|own| own.value).filter(|own| !own.is_empty())?;
    let mut all = Checked { value: Vec::new(), warnings: Diagnostics::default() };
    for name in names {
        match read_named_model(text, &name, options) {
            Ok(own) => {
                all.value.push(own.value);
                let is_new = |one: &Diagnostic| !all.warnings.list.contains(one);
                let new: Vec<_> = own.warnings.list.into_iter().filter(is_new).collect();
                all.warnings.list.extend(new);
            }
            Err(faults) => return Some(Err(faults)),
        }
    }
    Some(Ok(all))
}

/// Where a name leads, and whether it leads elsewhere, too.
fn find<'d>(library: &'d Library, name: &str) -> Result<(Found<'d>, bool), Fault> {
    let elements = library.section("elements").and_then(|entry| entry.item.table()).unwrap_or(&[]);
    let models = || MODEL_SECTIONS.into_iter().flat_map(|section| library.models(0, section));
    if name.is_empty() {
        let found: Vec<Found<'_>> = if models().next().is_some() {
            models().map(Found::Model).collect()
        } else {
            elements.iter().map(Found::Element).collect()
        };
        let mut found = found.into_iter();
        return match (found.next(), found.next()) {
            (Some(only), None) => Ok((only, false)),
            _ => Err(Fault::WhichModel { known: known(library, elements) }),
        };
    }
    let (section, word) =
        name.split_once('.').map_or((None, name), |(own, word)| (Some(own), word));
    let is_asked = |own: &str| section.is_none_or(|section| section == own);
    let in_section = |section: ModelSection| {
        let found = library.own(0, section, word).filter(|_| is_asked(section.key()));
        found.map(Found::Model)
    };
    let element = elements.iter().find(|entry| entry.key == word && is_asked("elements"));
    let all = MODEL_SECTIONS.into_iter().filter_map(in_section).chain(element.map(Found::Element));
    let mut all = all.collect::<Vec<_>>().into_iter();
    let first = all.next().ok_or_else(|| {
        let (family, known) = ("model, material or element", known(library, elements));
        Fault::UnknownName { family, name: name.to_owned(), known }
    })?;
    Ok((first, all.next().is_some()))
}

/// All names that lead to a model.
fn known(library: &Library, elements: &[Entry]) -> Vec<String> {
    let models = MODEL_SECTIONS.into_iter().flat_map(|section| library.names(0, section));
    let mut known: Vec<String> =
        models.chain(elements.iter().map(|entry| entry.key.to_string())).collect();
    known.sort();
    known.dedup();
    known
}

/// What is to be said of numbers with scatter that may stand in this model.
fn means(text: &str, entry: &Entry) -> impl Iterator<Item = ModelNote> {
    let name = entry.key.to_string();
    let all = ScatteredNumber::all(text, None).unwrap_or_default().into_iter();
    let own = all.filter(move |own| {
        let mut parts = own.path.split('.');
        parts.next() == Some("values") || parts.next() == Some(&name)
    });
    own.map(|own| ModelNote { subject: own.name, what: Remark::Mean(own.text), until: None })
}

/// The whole lines that an entry takes.
fn lines_of(source: &Source, entry: &Entry) -> Range<usize> {
    let mut span = entry.key_place.span();
    let mut open: Vec<&Item> = vec![&entry.item];
    while let Some(item) = open.pop() {
        let own = item.place.span();
        span = span.start.min(own.start)..span.end.max(own.end);
        match &item.value {
            Content::List(items) => open.extend(items),
            Content::Table(entries) => open.extend(entries.iter().map(|entry| &entry.item)),
            _ => {}
        }
    }
    source.lines(&span, usize::MAX)
}
