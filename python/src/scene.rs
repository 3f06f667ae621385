//! Scenes, read once and run often.

use std::{
    path::PathBuf,
    sync::{Arc, OnceLock},
};

use dashpot_cli::{RunOptions, Said, ScatterArguments, SceneRun, open, read_scene};
use dashpot_scene::Tunables;
use dashpot_units::si_unit;
use pyo3::{prelude::*, types::PyList};

use crate::{
    failure::{Kind, failure, listed, sentence},
    report::Report,
    study,
    watch::{Asking, OfRun},
};

/// Where nothing says which method.
const AUTO: &str = "auto";

/// The name of the file and the text of a scene: a file, or a built-in scene.
#[pyfunction]
pub(crate) fn opened(py: Python<'_>, path: PathBuf) -> PyResult<(String, String)> {
    open(&path).map_err(|said| failure(py, Kind::Input, &said))
}

/// A scene that was read and is valid.
#[pyclass(frozen, module = "dashpot._dashpot")]
pub(crate) struct Scene {
    read: dashpot_scene::Scene,
    /// What is to be said about it.
    said: Vec<Said>,
    /// What was set in place of what it says.
    set: Vec<(String, String)>,
    tunables: OnceLock<Tunables>,
}

#[pymethods]
impl Scene {
    #[new]
    #[pyo3(signature = (text, file=None, values=Vec::new()))]
    fn new(
        py: Python<'_>,
        text: &str,
        file: Option<&str>,
        values: Vec<(String, String)>,
    ) -> PyResult<Self> {
        let read = py.detach(|| read_scene(text, file, &values));
        let (scene, said) = read.map_err(|said| failure(py, Kind::Input, &said))?;
        Ok(Self { read: scene, said, set: values, tunables: OnceLock::new() })
    }

    /// Its title.
    #[getter]
    fn title(&self) -> Option<&str> {
        self.read.title.as_deref()
    }

    /// Its text, with all values as they were set, those under `[values]` as well.
    #[getter]
    fn text(&self, py: Python<'_>) -> PyResult<String> {
        let all = self.tunables(py)?;
        let named = self.set.iter().filter_map(|(name, value)| {
            // What is set by a path stands in the text already.
            let is_named = self.read.values.iter().any(|own| own.name == *name);
            is_named.then(|| all.find(name).ok().map(|at| (at, value.clone())))?
        });
        Ok(all.text_with(&named.collect::<Vec<_>>()))
    }

    /// How long it runs \[s\].
    #[getter]
    fn duration(&self) -> f64 {
        self.read.run.duration
    }

    /// The methods that it names.
    #[getter]
    fn methods(&self) -> Vec<String> {
        self.read.run.methods.iter().map(ToString::to_string).collect()
    }

    /// What is to be said about it, as dictionaries: warnings and notes.
    #[getter]
    fn said<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        listed(py, &self.said)
    }

    /// Other files that it reads.
    #[getter]
    fn files(&self) -> Vec<String> {
        self.read.files.clone()
    }

    /// The drawing of its network as SVG; empty where there is too much to be drawn.
    fn drawing(&self) -> String {
        dashpot_cli::drawing(&self.read).unwrap_or_default()
    }

    /// Its numbers: name, value and unit in SI, and as it is written.
    fn numbers(&self, py: Python<'_>) -> PyResult<Vec<(String, f64, String, String)>> {
        let all = self.tunables(py)?;
        let own = all.all().iter().enumerate().filter(|(_, own)| own.word.is_none());
        let row = |(at, own): (usize, &dashpot_scene::Tunable)| {
            let unit = own.dimension.map_or_else(String::new, si_unit);
            (own.name.clone(), own.value, unit, all.shown(at))
        };
        Ok(own.map(row).collect())
    }

    /// A value of the number of this name as a text that is read back to the same bits.
    fn written(&self, py: Python<'_>, name: &str, value: f64) -> PyResult<String> {
        let text = study::written(self.tunables(py)?, name, value);
        text.map_err(|said| failure(py, Kind::Input, &[said]))
    }

    /// Solves it by the method of this name, or by the one that it names, or else by what suits.
    #[pyo3(signature = (method=None, *, accuracy=None, neglect=None, rtol=None, estimate=true, budget=None, measures=Vec::new(), sample=500, seed=1, floor=false, progress=None))]
    #[expect(clippy::too_many_arguments, reason = "each is an argument of Python, by its name")]
    fn solve(
        &self,
        py: Python<'_>,
        method: Option<&str>,
        accuracy: Option<f64>,
        neglect: Option<f64>,
        rtol: Option<f64>,
        estimate: bool,
        budget: Option<u64>,
        measures: Vec<String>,
        sample: usize,
        seed: u64,
        floor: bool,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Report> {
        let method = method.unwrap_or(match &self.read.run.methods[..] {
            [own] => own,
            _ => AUTO,
        });
        let (without_errors, sample) = (!estimate, ScatterArguments::new(sample, seed));
        let options =
            RunOptions { accuracy, neglect, rtol, without_errors, budget, measures, sample, floor };
        let mut observer = OfRun::new(Asking::new(progress), self.read.run.duration);
        let (scene, asked) = ((&self.read, &self.read.assembly), (&options, method));
        let solved = py.detach(|| SceneRun::of(scene, &self.set, asked, &mut observer));
        if let Some(error) = observer.raised {
            return Err(error);
        }
        let solved = solved.map_err(|(status, said)| {
            // What is wrong with the scene is wrong input.
            failure(py, if status == 2 { Kind::Input } else { Kind::Run }, &said)
        })?;
        Ok(Report::new(solved, Arc::clone(&self.read.assembly)))
    }
}

impl Scene {
    fn tunables(&self, py: Python<'_>) -> PyResult<&Tunables> {
        if let Some(known) = self.tunables.get() {
            return Ok(known);
        }
        let found = Tunables::of(&self.read.text, self.read.file.as_deref());
        let found = found.map_err(|all| sentence(py, Kind::Input, &all.render(false)))?;
        Ok(self.tunables.get_or_init(|| found))
    }
}
