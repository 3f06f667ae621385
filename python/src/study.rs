//! Studies: requests made of Python's values, and answers as its objects.

use std::{collections::HashMap, ops::ControlFlow, path::Path, sync::Arc};

use dashpot_cli::{Said, Tone};
use dashpot_network::parameters::Dimension;
use dashpot_scene::{Diagnostics, Tunables, units::si_unit};
use dashpot_studies::{
    BUILT_IN, Context, Given, Input, Kind, Operands, OptionInfo, Outcome, Progress, Remark,
    STUDIES, StudyError, operand::parted,
};
use pyo3::{
    exceptions::PyTypeError,
    prelude::*,
    types::{PyBool, PyDict, PyList, PyMapping, PyString, PyTuple},
};
use pythonize::pythonize;

use crate::{
    call::Work,
    failure::{self, failure, listed},
    watch::{Asking, Share},
};

/// All studies as dictionaries: `word`, `about`, `operands`, and `options` with what each takes.
#[pyfunction]
pub(crate) fn studies(py: Python<'_>) -> PyResult<Bound<'_, PyList>> {
    let all = PyList::empty(py);
    for study in STUDIES {
        let entry = PyDict::new(py);
        entry.set_item("word", study.word())?;
        entry.set_item("about", study.about())?;
        let operands: Vec<&str> = match study.operands() {
            Operands::Scene => vec!["scene"],
            Operands::Files(_) => vec!["*files"],
            Operands::Models(models) => models.iter().map(|model| model.0).collect(),
        };
        entry.set_item("operands", operands)?;
        let options = PyList::empty(py);
        for option in study.options() {
            options.append(described(py, option)?)?;
        }
        entry.set_item("options", options)?;
        all.append(entry)?;
    }
    Ok(all)
}

fn described<'py>(py: Python<'py>, option: &OptionInfo) -> PyResult<Bound<'py, PyDict>> {
    let (kind, unit) = match option.kind {
        Kind::Text => ("text", ""),
        Kind::Amount => ("amount", ""),
        Kind::Count => ("count", ""),
        Kind::Quantity(unit) => ("quantity", unit),
        Kind::Words(_) => ("words", ""),
        Kind::Assignment => ("assignment", ""),
        Kind::Switch => ("switch", ""),
    };
    let words = match option.kind {
        Kind::Words(words) => words().into_iter().map(|word| word.0).collect(),
        _ => Vec::new(),
    };
    let entry = PyDict::new(py);
    entry.set_item("name", option.name)?;
    entry.set_item("alias", option.alias)?;
    entry.set_item("about", option.about())?;
    entry.set_item("kind", kind)?;
    entry.set_item("unit", unit)?;
    entry.set_item("words", words)?;
    entry.set_item("several", option.several.is_some())?;
    entry.set_item("default", option.default)?;
    Ok(entry)
}

/// What a study answers: `status` as that of the command, the result, and what was said besides. A name in `texts` stands
/// for a file with that text.
///
/// The work has a thread of its own, so that an interrupt is heard whatever it is at.
#[pyfunction]
#[pyo3(signature = (word, operands, set, options, texts, progress=None))]
pub(crate) fn ask<'py>(
    py: Python<'py>,
    word: &str,
    operands: Vec<String>,
    set: Vec<(String, Bound<'py, PyAny>)>,
    options: Bound<'py, PyDict>,
    texts: HashMap<String, String>,
    progress: Option<Py<PyAny>>,
) -> PyResult<(u8, Bound<'py, PyAny>, Bound<'py, PyList>)> {
    let study = STUDIES.iter().find(|study| study.word() == word);
    let study = *study.ok_or_else(|| PyTypeError::new_err(format!("there is no study {word}")))?;
    let mut request = Vec::new();
    for (name, value) in options {
        let name: String = name.extract()?;
        let values = given(&value)?;
        let is_one = study.options().iter().any(|own| own.name == name && own.several.is_none());
        if is_one && values.len() > 1 {
            return Err(PyTypeError::new_err(format!(
                "`{name}` takes one value, not {}",
                values.len()
            )));
        }
        request.extend(values.into_iter().map(|given| (name.clone(), given)));
    }
    let set = set.iter().map(|(name, value)| {
        let text = assigned(name, &given(value)?, &operands, &texts);
        Ok((name.clone(), text.map_err(|said| failure(py, failure::Kind::Input, &[said]))?))
    });
    let set = set.collect::<PyResult<Vec<_>>>()?;
    let asking = Asking::new(progress);
    let answered = py.detach(|| {
        let share = Arc::new(Share::default());
        let told = Arc::clone(&share);
        let asked = Work::begun(move || {
            let mut memory = Memory { texts, share: told, said: Vec::new() };
            let answer = study.solve((&operands, &set), &request, &mut memory);
            Some(match answer {
                Ok(answer) => {
                    let warnings = answer.warnings().into_iter();
                    memory.said.extend(warnings.map(|own| Said::plain(Tone::Warning, own)));
                    let object = Python::attach(|py| {
                        Ok::<_, PyErr>(in_lists(pythonize(py, &*answer)?)?.unbind())
                    });
                    Ok((answer.outcome(), object, memory.said))
                }
                Err(error) => Err((error.is_of_input(), faults(&error))),
            })
        })?;
        asked.awaited(&share, &asking)
    })?;
    match answered {
        Some(Ok((outcome, object, said))) => {
            let status = match outcome {
                Outcome::Done => 0,
                Outcome::Failed => 1,
                Outcome::NotSame => 3,
                Outcome::LimitNotKept => 4,
            };
            Ok((status, object?.into_bound(py), listed(py, &said)?))
        }
        Some(Err((is_of_input, said))) => {
            let kind = if is_of_input { failure::Kind::Input } else { failure::Kind::Run };
            Err(failure(py, kind, &said))
        }
        None => Ok((0, py.None().into_bound(py), PyList::empty(py))),
    }
}

/// A result with lists in place of tuples, as JSON has them.
fn in_lists(value: Bound<'_, PyAny>) -> PyResult<Bound<'_, PyAny>> {
    if let Ok(entries) = value.cast::<PyDict>() {
        for (key, entry) in entries {
            entries.set_item(key, in_lists(entry)?)?;
        }
    } else if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        let items = value.try_iter()?.map(|item| in_lists(item?)).collect::<PyResult<Vec<_>>>()?;
        return Ok(PyList::new(value.py(), items)?.into_any());
    }
    Ok(value)
}

/// What an error says.
fn faults(error: &StudyError) -> Vec<Said> {
    match error {
        StudyError::Scene(Diagnostics { list, .. }) => list.iter().map(Said::from).collect(),
        error => {
            let plain = Said::plain(Tone::Error, error.to_string());
            vec![Said { help: error.help(), ..plain }]
        }
    }
}

/// What is given by a value: a text, a number, on or off, or several of them.
fn given(value: &Bound<'_, PyAny>) -> PyResult<Vec<Given>> {
    if value.is_none() {
        return Ok(Vec::new());
    }
    if value.is_instance_of::<PyBool>() {
        return Ok(vec![Given::Switch(value.extract()?)]);
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(vec![Given::Text(text.extract()?)]);
    }
    if let Ok(named) = value.cast::<PyMapping>() {
        let mut all = Vec::new();
        for pair in named.items()?.iter() {
            let (name, value): (String, Bound<'_, PyAny>) = pair.extract()?;
            all.push(Given::Named(name, given(&value)?));
        }
        return Ok(all);
    }
    if let Ok(number) = value.extract::<f64>() {
        return Ok(vec![Given::Number(number)]);
    }
    if value.hasattr("__fspath__")? {
        return Ok(vec![Given::Text(value.call_method0("__fspath__")?.extract()?)]);
    }
    let parts = value.try_iter()?.map(|part| given(&part?));
    Ok(parts.collect::<PyResult<Vec<_>>>()?.concat())
}

/// The text of values that are set; numbers are in the SI unit of the number of that name in the first operand that has one.
fn assigned(
    name: &str,
    values: &[Given],
    operands: &[String],
    texts: &HashMap<String, String>,
) -> Result<String, Said> {
    let memory = Memory { texts: texts.clone(), share: Arc::default(), said: Vec::new() };
    let text = |value: &Given| match value {
        Given::Number(number) => {
            let mut fault = None;
            let built_in = [BUILT_IN.to_owned()];
            let operands = if operands.is_empty() { &built_in[..] } else { operands };
            for operand in operands {
                let Ok(input) = memory.input(parted(operand, &memory).0) else { continue };
                let Ok(text) = input.text() else { continue };
                let Ok(tunables) = Tunables::of(text, Some(&input.file)) else { continue };
                match written(&tunables, name, *number) {
                    Ok(text) => return Ok(text),
                    Err(said) => fault = fault.or(Some(said)),
                }
            }
            // Whatever is wrong with the text is said where it is read.
            fault.map_or_else(|| Ok(number.to_string()), Err)
        }
        Given::Text(text) => Ok(text.clone()),
        _ => Err(Said::plain(Tone::Error, format!("`{name}` takes a number or a text"))),
    };
    Ok(values.iter().map(text).collect::<Result<Vec<_>, _>>()?.join(","))
}

/// A value of the number of this name, in its SI unit, as a text that is read back to the same bits.
pub(crate) fn written(tunables: &Tunables, name: &str, value: f64) -> Result<String, Said> {
    let place = tunables.find(name).map_err(|fault| Said {
        help: fault.help(),
        ..Said::plain(Tone::Error, fault.to_string())
    })?;
    let dimension = tunables.all()[place].dimension.filter(|own| *own != Dimension::NUMBER);
    let unit = dimension.map_or_else(String::new, |dimension| format!(" {}", si_unit(dimension)));
    Ok(format!("{value:?}{unit}"))
}

/// What surrounds a study that Python asks.
struct Memory {
    texts: HashMap<String, String>,
    share: Arc<Share>,
    said: Vec<Said>,
}

impl Context for Memory {
    fn load(&self, name: &str) -> Result<Vec<u8>, String> {
        dashpot_cli::load(name)
    }

    fn has(&self, name: &str) -> bool {
        self.texts.contains_key(name) || Path::new(name).is_file()
    }

    fn folder(&self, name: &str) -> Option<Result<Vec<String>, String>> {
        dashpot_cli::folder(Path::new(name))
    }

    fn input(&self, name: &str) -> Result<Input, StudyError> {
        match self.texts.get(name) {
            Some(text) => Ok(Input::new(name, text.clone().into_bytes())),
            None => dashpot_cli::read_input(Path::new(name)),
        }
    }

    fn remark(&mut self, remark: Remark<'_>) {
        self.said.extend(match remark {
            Remark::Odd(diagnostics) => diagnostics.list.iter().map(Said::from).collect(),
            Remark::Model(note) => {
                vec![Said::plain(Tone::Note, format!("{}: {}", note.subject, note.what))]
            }
            Remark::Warning(text) => vec![Said::plain(Tone::Warning, text)],
            Remark::Note(text) => vec![Said::plain(Tone::Note, text)],
        });
    }

    fn progress(&mut self, progress: Progress) -> ControlFlow<()> {
        self.share.tell(progress.share())
    }
}
