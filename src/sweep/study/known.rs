//! Scenes with known load factors.

use scene::Scene;

/// A scene and its load factor.
#[derive(Clone, Debug)]
pub struct Known {
    /// Name, as `--scenes` takes it.
    pub name: &'static str,
    /// The scene.
    pub scene: Scene,
    /// The associative load factor.
    pub truth: f64,
    /// The load factor with dry friction, where it is known.
    pub dry: Option<f64>,
    /// Where the values come from.
    pub source: &'static str,
}
