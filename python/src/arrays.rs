//! Numbers as numpy arrays. What is computed here is moved into its array: no second copy.

use numpy::{PyArray1, PyArray2, PyReadonlyArray2, ToPyArray, ndarray::Array2};
use pyo3::prelude::*;

/// Rows of three: `n × 3`.
pub fn rows<'py>(py: Python<'py>, rows: Vec<[f64; 3]>) -> Bound<'py, PyArray2<f64>> {
    let count = rows.len();
    // The same memory, seen as one row of numbers.
    match Array2::from_shape_vec((count, 3), rows.into_flattened()) {
        Ok(array) => PyArray2::from_owned_array(py, array),
        // Its length is three times the count; there is no other way to be wrong.
        Err(_) => PyArray2::zeros(py, (0, 3), false),
    }
}

/// Whole numbers.
pub fn counts<'py>(py: Python<'py>, counts: &[i64]) -> Bound<'py, PyArray1<i64>> {
    counts.to_pyarray(py)
}

/// The rows of an array `n × 3`.
pub fn points(array: &PyReadonlyArray2<f64>) -> Option<Vec<[f64; 3]>> {
    let view = array.as_array();
    let row = |r: numpy::ndarray::ArrayView1<f64>| Some([*r.get(0)?, *r.get(1)?, *r.get(2)?]);
    (view.ncols() == 3).then(|| view.rows().into_iter().map(row).collect())?
}
