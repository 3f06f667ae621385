//! Columns as an Arrow stream, which pandas, polars and `DuckDB` read without copies.

use std::sync::Arc;

use arrow_array::{
    ArrayRef, Float64Array, RecordBatch, RecordBatchIterator, StringArray,
    ffi_stream::FFI_ArrowArrayStream,
};
use pyo3::{prelude::*, types::PyCapsule};

use crate::failure::{Kind, sentence};

/// Columns of one length, with names.
#[pyclass(frozen, module = "dashpot._dashpot")]
pub(crate) struct Columns(RecordBatch);

/// The values of a column.
#[derive(FromPyObject)]
enum Values {
    /// Numbers; `None` is a value that is not there.
    #[pyo3(transparent)]
    Numbers(Vec<Option<f64>>),
    /// Words.
    #[pyo3(transparent)]
    Words(Vec<String>),
}

#[pymethods]
impl Columns {
    #[new]
    fn new(py: Python<'_>, columns: Vec<(String, Values)>) -> PyResult<Self> {
        let array = |values: Values| -> ArrayRef {
            match values {
                Values::Numbers(own) => Arc::new(Float64Array::from(own)),
                Values::Words(own) => Arc::new(StringArray::from(own)),
            }
        };
        let columns = columns.into_iter().map(|(name, values)| (name, array(values), true));
        let batch = RecordBatch::try_from_iter_with_nullable(columns);
        batch.map(Self).map_err(|error| sentence(py, Kind::Input, &error.to_string()))
    }

    /// The stream in a capsule, as the Arrow `PyCapsule` interface has it.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        // A schema is a wish, which may be left open.
        drop(requested_schema);
        let schema = self.0.schema();
        let batches = RecordBatchIterator::new([Ok(self.0.clone())], schema);
        let stream = FFI_ArrowArrayStream::new(Box::new(batches));
        PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
    }
}
