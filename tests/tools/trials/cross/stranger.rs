//! Blocks that have nothing to do with a scene, beside it: whatever they weigh, they must not
//! change its answer.

use super::scenes::extent;
use nalgebra::Vector3;
use scene::{BlockSpec, Friction, JointOverride, Material, Scene, Shape};
use serde::{Deserialize, Serialize};

/// A kind of stranger. All of them stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stranger {
    /// A block on the ground, five times as heavy as the scene.
    Resting,
    /// A column of [`COLUMN`] blocks: the softest thing around.
    Soft,
    /// A block a million times as heavy as the scene.
    Heavy,
    /// A block a million times lighter than the scene's lightest.
    Light,
}

/// Blocks of the column.
pub const COLUMN: usize = 50;

/// All kinds.
pub const STRANGERS: [Stranger; 4] =
    [Stranger::Resting, Stranger::Soft, Stranger::Heavy, Stranger::Light];

/// The material of strangers, which has joints of its own.
const MATERIAL: &str = "stranger";

/// The scene with a stranger beside it, before or after its own blocks. `masses` are those of its
/// free blocks, kg.
pub fn beside(scene: &Scene, masses: &[f64], stranger: Stranger, before: bool) -> Scene {
    let (low, high) = extent(scene);
    let size = (high - low).norm().max(f64::MIN_POSITIVE);
    let total: f64 = masses.iter().sum();
    let lightest = masses.iter().copied().fold(total, f64::min);
    let (count, height, mass) = match stranger {
        Stranger::Resting => (1, 0.5, 5.0 * total),
        Stranger::Soft => (COLUMN, 0.1, total / masses.len().max(1) as f64),
        Stranger::Heavy => (1, 0.5, 1e6 * total),
        Stranger::Light => (1, 0.5, 1e-6 * lightest),
    };
    let foot = Vector3::new(high.x + 3.0 * size, low.y, low.z);
    let cuboid = |id: String, size: [f64; 3], at: Vector3<f64>| BlockSpec {
        at: at.into(),
        material: Some(MATERIAL.into()),
        ..BlockSpec::new(id, Shape::Cuboid { size })
    };
    let ground = cuboid(
        "stranger-ground".into(),
        [size, size, 0.2 * size],
        foot - Vector3::z() * 0.1 * size,
    );
    let mut blocks = vec![BlockSpec { support: true, ..ground }];
    for k in 0..count {
        let up = Vector3::z() * ((k as f64 + 0.5) * height * size);
        blocks.push(BlockSpec {
            mass: Some(mass),
            ..cuboid(format!("stranger-{k:02}"), [0.5 * size, 0.5 * size, height * size], foot + up)
        });
    }
    let mut union = scene.clone();
    union.name = format!(
        "{}, {stranger:?} stranger {}",
        scene.name,
        if before { "before" } else { "after" }
    )
    .to_lowercase();
    union.materials.insert(MATERIAL.into(), Material::of_density(1.0));
    union.joints.overrides.push(JointOverride {
        between: Some([MATERIAL.into(), MATERIAL.into()]),
        blocks: None,
        friction: Some(Friction::Coefficient(0.6)),
        friction_angle_deg: None,
        cohesion: Some(0.0),
        tension: Some(0.0),
        // Where the scene's joints crush, the stranger's bear a thousand times what it presses
        // with.
        compression: scene
            .joints
            .default
            .compression
            .map(|_| 1e3 * count as f64 * mass * 9.81 / (0.5 * size).powi(2)),
        pore_pressure: Some(0.0),
        rolling_arm: Some(0.0),
        normal_stiffness: None,
        shear_stiffness: None,
    });
    if before {
        blocks.append(&mut union.blocks);
        union.blocks = blocks;
    } else {
        union.blocks.append(&mut blocks);
    }
    union
}

/// The same scene at `by`, m.
pub fn moved(scene: &Scene, by: [f64; 3]) -> Scene {
    let mut there = scene.clone();
    there.name = format!("{}, at {by:?}", scene.name);
    for block in &mut there.blocks {
        (0..3).for_each(|k| block.at[k] += by[k]);
    }
    there
}

/// The same scene in whose joints nothing slides.
pub fn rough(scene: &Scene) -> Scene {
    let mut rough = scene.clone();
    rough.name = format!("{}, infinite friction", scene.name);
    rough.joints.default.friction = Some(Friction::Infinite);
    rough.joints.overrides.iter_mut().for_each(|rule| rule.friction = Some(Friction::Infinite));
    rough
}
