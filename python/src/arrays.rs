//! Numbers as numpy arrays, which nobody can write into: they belong to answers. What is computed
//! here is moved into its array: no second copy.

use numpy::{
    Element, PyArray, PyArray1, PyArray2, PyArrayMethods, ToPyArray,
    ndarray::{Array2, Dimension},
};
use pyo3::prelude::*;

/// An array that is only read. One that is borrowed already stays as it is: none is, this early.
fn fixed<'py, T: Element, D: Dimension>(
    array: Bound<'py, PyArray<T, D>>,
) -> Bound<'py, PyArray<T, D>> {
    if let Ok(array) = array.try_readwrite() {
        drop(array.make_nonwriteable());
    }
    array
}

/// A row of numbers.
pub fn numbers<T: Element>(py: Python, numbers: Vec<T>) -> Bound<PyArray1<T>> {
    fixed(PyArray1::from_vec(py, numbers))
}

/// Rows of three: `n × 3`.
pub fn rows<'py>(py: Python<'py>, rows: Vec<[f64; 3]>) -> Bound<'py, PyArray2<f64>> {
    let count = rows.len();
    // The same memory, seen as one row of numbers.
    match Array2::from_shape_vec((count, 3), rows.into_flattened()) {
        Ok(array) => fixed(PyArray2::from_owned_array(py, array)),
        // Its length is three times the count; there is no other way to be wrong.
        Err(_) => PyArray2::zeros(py, (0, 3), false),
    }
}

/// Whole numbers.
pub fn counts<'py>(py: Python<'py>, counts: &[i64]) -> Bound<'py, PyArray1<i64>> {
    fixed(counts.to_pyarray(py))
}
