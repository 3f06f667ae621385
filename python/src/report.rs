//! What a run yields.

use std::{borrow::Cow, sync::Arc};

use dashpot_analysis::{MeasureReport, Warning, regular_times, table_at};
use dashpot_cli::SceneRun;
use dashpot_network::Assembly;
use pyo3::{
    exceptions::PyKeyError,
    prelude::*,
    types::{PyDict, PyTuple, PyType},
};

use crate::failure::{Kind, array, sentence};

/// One measure of a run: value and error in the SI unit `unit`, `time` and `window` in seconds.
#[pyclass(frozen, module = "dashpot", get_all)]
pub(crate) struct Measure {
    /// `<element or node>.<kind>`.
    key: String,
    /// `None` where it is infinite, undefined, or not determined: `note` says why.
    value: Option<f64>,
    /// Its absolute error; `None` where it was not estimated.
    error: Option<f64>,
    /// Its SI unit.
    unit: Cow<'static, str>,
    /// When it occurs.
    time: Option<f64>,
    /// The part of the run that it belongs to.
    window: Option<(f64, f64)>,
    /// What is to be said about it.
    note: Option<String>,
}

/// What a measure is made of.
type Parts<'m> =
    (&'m str, Option<f64>, Option<f64>, &'m str, Option<f64>, Option<(f64, f64)>, Option<&'m str>);

#[pymethods]
impl Measure {
    #[new]
    #[pyo3(signature = (key, value, error, unit, time=None, window=None, note=None))]
    fn new(
        key: String,
        value: Option<f64>,
        error: Option<f64>,
        unit: String,
        time: Option<f64>,
        window: Option<(f64, f64)>,
        note: Option<String>,
    ) -> Self {
        Self { key, value, error, unit: unit.into(), time, window, note }
    }

    fn __reduce__<'m>(own: &'m Bound<'_, Self>) -> (Bound<'m, PyType>, Parts<'m>) {
        let Self { key, value, error, unit, time, window, note } = own.get();
        (own.get_type(), (key, *value, *error, unit, *time, *window, note.as_deref()))
    }

    fn __float__(&self, py: Python<'_>) -> PyResult<f64> {
        let why = || self.note.clone().unwrap_or_else(|| "it has no value".to_owned());
        self.value.ok_or_else(|| sentence(py, Kind::Run, &format!("`{}`: {}", self.key, why())))
    }

    fn __repr__(&self) -> String {
        let value = self.value.map_or_else(|| "None".to_owned(), |own| own.to_string());
        let error = self.error.map_or_else(String::new, |own| format!(" ± {own:.1e}"));
        format!("<{}: {value}{error} {}>", self.key, self.unit)
    }
}

impl From<&MeasureReport> for Measure {
    fn from(own: &MeasureReport) -> Self {
        Self {
            key: own.key.clone(),
            value: own.value,
            error: own.error.filter(|own| own.is_finite()),
            unit: own.unit.into(),
            time: own.time,
            window: own.window,
            note: own.note(),
        }
    }
}

/// A run: its measures, warnings and curves.
#[pyclass(frozen, module = "dashpot._dashpot")]
pub(crate) struct Report {
    run: SceneRun,
    /// What the scene was compiled to, with what its own text has been warned of.
    of_scene: Arc<Assembly>,
}

impl Report {
    pub(crate) fn new(run: SceneRun, of_scene: Arc<Assembly>) -> Self {
        Self { run, of_scene }
    }

    fn told(&self, is_meant: impl Fn(&Warning) -> bool) -> Vec<(&'static str, String)> {
        let warnings = self.run.report.warnings.iter().filter(|own| is_meant(own));
        warnings.map(|own| (own.code(), own.to_string())).collect()
    }
}

#[pymethods]
impl Report {
    /// The method that solved it.
    #[getter]
    fn method(&self) -> &'static str {
        self.run.report.solver.method
    }

    /// When it ended \[s\].
    #[getter]
    fn end(&self) -> f64 {
        self.run.report.energy.time
    }

    /// What the engine took for it by the clock \[s\].
    #[getter]
    fn wall(&self) -> f64 {
        self.run.report.solver.wall_in_all.as_secs_f64()
    }

    /// The keys of its measures.
    fn keys(&self) -> Vec<&str> {
        self.run.report.told().map(|own| own.key.as_str()).collect()
    }

    /// The warnings, each with its code.
    #[getter]
    fn warnings(&self) -> Vec<(&'static str, String)> {
        self.told(|_| true)
    }

    /// Those that have not been told of the scene itself.
    #[getter]
    fn new_warnings(&self) -> Vec<(&'static str, String)> {
        let known = &self.of_scene.warnings;
        self.told(|own| !matches!(own, Warning::Network(own) if known.contains(own)))
    }

    /// All measures that it has, told or not.
    fn measures(&self) -> Vec<Measure> {
        self.run.report.measures.iter().map(Measure::from).collect()
    }

    /// The measure of this key.
    fn measure(&self, key: &str) -> PyResult<Measure> {
        match self.run.report.measure(key) {
            Some(own) => Ok(own.into()),
            None => Err(PyKeyError::new_err(match self.run.report.value(key) {
                Err(why) => why.to_string(),
                Ok(_) => key.to_owned(),
            })),
        }
    }

    /// The object of the run, as `--json` has it among its runs.
    fn json(&self, py: Python<'_>) -> PyResult<String> {
        serde_json::to_string(&self.run)
            .map_err(|error| sentence(py, Kind::Run, &error.to_string()))
    }

    /// Outputs over time at `times` \[s\], or at so many regular ones: the times, and by the name of each output its SI
    /// unit and values.
    #[pyo3(signature = (times=None, count=501))]
    fn outputs<'py>(
        &self,
        py: Python<'py>,
        times: Option<Vec<f64>>,
        count: usize,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let end = self.run.report.trajectory.t_end;
        let times = times.unwrap_or_else(|| regular_times(end, count));
        let is_wrong = |pair: &[f64]| pair[0].is_nan() || pair[0] > pair[1];
        let is_beyond = times.iter().any(|own| !(0.0..=end).contains(own));
        if is_beyond || times.windows(2).any(is_wrong) {
            let message = format!("times have to rise, from 0 to the end of the run, {end} s");
            return Err(sentence(py, Kind::Input, &message));
        }
        let table =
            py.detach(|| table_at(&self.run.report.assembly, &self.run.report.trajectory, times));
        let columns = PyDict::new(py);
        for own in table.columns {
            columns.set_item(own.name, (own.unit, array(py, &own.values)?))?;
        }
        (array(py, &table.times)?, columns).into_pyobject(py)
    }
}
