//! Combinations that mean something, and the factors of the one that is in force.

use base::error::{InputError, JsonPath};
use scene::{Factors, Scene};

/// The factors in force; refuses combinations that no factors can be made of.
pub(super) fn resolve(scene: &Scene) -> Result<Factors, InputError> {
    let path = JsonPath::root().key("combinations");
    for (k, c) in scene.combinations.iter().enumerate() {
        let here = path.index(k).key("name");
        if c.name.trim().is_empty() {
            return Err(InputError::at(here, "the name is empty").hint("such as \"STR\""));
        }
        if scene.combinations[..k].iter().any(|other| other.name == c.name) {
            let text = format!("the name {:?} is already that of another combination", c.name);
            return Err(InputError::at(here, text).hint("every combination needs its own name"));
        }
        scene.factors_in(k)?;
    }
    scene.factors()
}
