//! Backward differentiation by CVODE (`hindmarsh2005` in `docs/references.bib`) with a banded matrix, from
//! an installed SUNDIALS 7 that is loaded when it is asked for.

mod library;

use std::{ffi::c_int, path::Path, ptr::null_mut, slice};

use library::{Functions, Index, Object};

/// `CV_BDF`, `CV_ONE_STEP`, `CV_TSTOP_RETURN`.
const BACKWARD: c_int = 2;
const ONE_STEP: c_int = 2;
const AT_STOP: c_int = 1;
/// Most steps from one call to the next: any number.
const ANY: i64 = -1;

/// An initial-value problem whose matrix of slopes is banded.
pub trait Banded {
    /// The states at time 0.
    fn start(&self) -> Vec<f64>;
    /// How far below and above the diagonal the band reaches.
    fn reach(&self) -> (usize, usize);
    /// The rates of the states.
    fn rates(&self, state: &[f64], rates: &mut [f64]);
    /// The change of the rates with a change of the states.
    fn slopes(&self, state: &[f64], change: &[f64], rates: &mut [f64]);
}

/// Whose slopes CVODE works with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Slopes {
    /// Those of the problem.
    Own,
    /// CVODE's difference quotients.
    Quotients,
}

/// CVODE.
#[derive(Debug, Clone, Copy)]
pub struct Cvode(Functions);

impl Cvode {
    /// Loads the shared library of CVODE that lies at `path`.
    ///
    /// # Errors
    ///
    /// It cannot be opened, is not version 7, or misses a function.
    pub fn open(path: &Path) -> Result<Self, String> {
        library::open(path).map(Self).map_err(|reason| format!("{}: {reason}", path.display()))
    }

    /// Integrates from time 0 to the last of `times` and shows the states at each of them to `see`; with one
    /// relative and absolute tolerance for all.
    ///
    /// # Errors
    ///
    /// CVODE takes no further step.
    pub fn solve(
        &self,
        problem: &dyn Banded,
        slopes: Slopes,
        tolerance: f64,
        times: &[f64],
        see: &mut dyn FnMut(&[f64]),
    ) -> Result<(), String> {
        Run::new(self.0, problem, slopes, tolerance)?.to(times, see)
    }
}

/// What the functions called by CVODE know.
struct Data<'p> {
    functions: Functions,
    problem: &'p dyn Banded,
    size: usize,
    reach: (usize, usize),
    change: Vec<f64>,
    rates: Vec<f64>,
}

/// All objects of one run, of which those that are missing are null.
struct Run<'p> {
    functions: Functions,
    size: usize,
    context: Object,
    state: Object,
    between: Object,
    matrix: Object,
    solver: Object,
    memory: Object,
    data: Box<Data<'p>>,
}

impl<'p> Run<'p> {
    fn new(
        functions: Functions,
        problem: &'p dyn Banded,
        slopes: Slopes,
        tolerance: f64,
    ) -> Result<Self, String> {
        let (start, reach) = (problem.start(), problem.reach());
        let size = start.len();
        let (change, rates) = (vec![0.0; size], vec![0.0; size]);
        let data = Box::new(Data { functions, problem, size, reach, change, rates });
        let mut run = Self {
            functions,
            size,
            context: null_mut(),
            state: null_mut(),
            between: null_mut(),
            matrix: null_mut(),
            solver: null_mut(),
            memory: null_mut(),
            data,
        };
        run.prepare(&start, slopes, tolerance)?;
        Ok(run)
    }

    fn prepare(&mut self, start: &[f64], slopes: Slopes, tolerance: f64) -> Result<(), String> {
        let own = self.functions;
        let (size, (below, above)) = (index(self.size)?, self.data.reach);
        // SAFETY: each object is checked before it is used, and lives until the run is dropped, as does the
        // data that is handed over.
        unsafe {
            done("SUNContext_Create", (own.new_context)(0, &raw mut self.context))?;
            self.state = there("N_VNew_Serial", (own.new_vector)(size, self.context))?;
            self.between = there("N_VNew_Serial", (own.new_vector)(size, self.context))?;
            slice::from_raw_parts_mut((own.numbers)(self.state), self.size).copy_from_slice(start);
            let (below, above) = (index(below)?, index(above)?);
            let matrix = (own.new_band)(size, above, below, self.context);
            self.matrix = there("SUNBandMatrix", matrix)?;
            let solver = (own.new_solver)(self.state, self.matrix, self.context);
            self.solver = there("SUNLinSol_Band", solver)?;
            self.memory = there("CVodeCreate", (own.create)(BACKWARD, self.context))?;
            done("CVodeInit", (own.init)(self.memory, rates, 0.0, self.state))?;
            done("CVodeSStolerances", (own.tolerances)(self.memory, tolerance, tolerance))?;
            let data: *mut Data<'p> = &raw mut *self.data;
            done("CVodeSetUserData", (own.set_data)(self.memory, data.cast()))?;
            done("CVodeSetMaxNumSteps", (own.set_steps)(self.memory, ANY))?;
            let set = (own.set_solver)(self.memory, self.solver, self.matrix);
            done("CVodeSetLinearSolver", set)?;
            if slopes == Slopes::Own {
                done("CVodeSetJacFn", (own.set_jacobian)(self.memory, jacobian))?;
            }
        }
        Ok(())
    }

    fn to(&mut self, times: &[f64], see: &mut dyn FnMut(&[f64])) -> Result<(), String> {
        let (own, end) = (self.functions, times.last().copied().unwrap_or_default());
        // SAFETY: all objects are there, and the vectors have `size` numbers.
        unsafe {
            done("CVodeSetStopTime", (own.set_stop)(self.memory, end))?;
            let (mut now, mut next) = (0.0, 0);
            while next < times.len() {
                let ended = (own.advance)(self.memory, end, self.state, &raw mut now, ONE_STEP);
                done("CVode", ended)?;
                // At the end the time may be a rounding short.
                let reached = if ended == AT_STOP { end } else { now };
                while times.get(next).is_some_and(|&time| time <= reached) {
                    let time = times[next].min(now);
                    done("CVodeGetDky", (own.interpolate)(self.memory, time, 0, self.between))?;
                    see(slice::from_raw_parts((own.numbers)(self.between), self.size));
                    next += 1;
                }
            }
        }
        Ok(())
    }
}

impl Drop for Run<'_> {
    fn drop(&mut self) {
        let own = self.functions;
        // SAFETY: what is freed was made, is used no more, and the context goes last.
        unsafe {
            if !self.memory.is_null() {
                (own.free)(&raw mut self.memory);
            }
            if !self.solver.is_null() {
                (own.free_solver)(self.solver);
            }
            if !self.matrix.is_null() {
                (own.free_matrix)(self.matrix);
            }
            for vector in [self.state, self.between] {
                if !vector.is_null() {
                    (own.free_vector)(vector);
                }
            }
            if !self.context.is_null() {
                (own.free_context)(&raw mut self.context);
            }
        }
    }
}

extern "C" fn rates(_time: f64, state: Object, rates: Object, data: Object) -> c_int {
    // SAFETY: `data` is what the run has handed over, and the vectors have its size.
    unsafe {
        let data = &*data.cast::<Data<'_>>();
        let own = data.functions;
        let state = slice::from_raw_parts((own.numbers)(state), data.size);
        data.problem.rates(state, slice::from_raw_parts_mut((own.numbers)(rates), data.size));
    }
    0
}

/// Columns that share no row are found together.
extern "C" fn jacobian(
    _time: f64,
    state: Object,
    _rates: Object,
    matrix: Object,
    data: Object,
    _first: Object,
    _second: Object,
    _third: Object,
) -> c_int {
    // SAFETY: as above, and entries lie within the band of their column, the diagonal at its address.
    unsafe {
        let data = &mut *data.cast::<Data<'_>>();
        let own = data.functions;
        let state = slice::from_raw_parts((own.numbers)(state), data.size);
        let (below, above) = data.reach;
        let period = below + above + 1;
        for first in 0..period.min(data.size) {
            data.change.fill(0.0);
            data.change.iter_mut().skip(first).step_by(period).for_each(|own| *own = 1.0);
            data.problem.slopes(state, &data.change, &mut data.rates);
            for column in (first..data.size).step_by(period) {
                let (from, to) =
                    (column.saturating_sub(above), (column + below).min(data.size - 1));
                let entries = (own.column)(matrix, Index::try_from(column).unwrap_or(Index::MAX))
                    .sub(column - from);
                slice::from_raw_parts_mut(entries, to - from + 1)
                    .copy_from_slice(&data.rates[from..=to]);
            }
        }
    }
    0
}

fn index(number: usize) -> Result<Index, String> {
    Index::try_from(number).map_err(|fault| fault.to_string())
}

/// Turns a negative answer into an error.
fn done(name: &str, answer: c_int) -> Result<(), String> {
    if answer < 0 { Err(format!("{name} answers {answer}")) } else { Ok(()) }
}

fn there(name: &str, object: Object) -> Result<Object, String> {
    if object.is_null() { Err(format!("{name} has no room")) } else { Ok(object) }
}
