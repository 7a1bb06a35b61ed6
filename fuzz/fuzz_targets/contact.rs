//! Two to four blocks, near or in each other → every contact between them.
#![no_main]
use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use voussoir::{
    interface::prepare,
    scene::{BlockSpec, Friction, Rotation, Scene, Shape},
};

#[derive(Arbitrary, Debug)]
enum Kind {
    Box([u8; 3]),
    Sphere(u8),
    Prism(Vec<[i8; 2]>, u8),
}

#[derive(Arbitrary, Debug)]
struct Piece {
    kind: Kind,
    at: [i8; 3],
    /// A nudge out of the grid: axis and power of ten.
    nudge: (u8, u8),
    turn: Option<([i8; 3], i16)>,
}

fn length(x: u8) -> f64 {
    0.25 * f64::from(1 + x % 16)
}

fn block(k: usize, piece: &Piece) -> BlockSpec {
    let shape = match &piece.kind {
        Kind::Box(size) => Shape::Cuboid { size: size.map(length) },
        Kind::Sphere(r) => Shape::Sphere { radius: length(*r) },
        Kind::Prism(corners, depth) => Shape::Prism {
            polygon: corners.iter().take(12).map(|c| c.map(|x| 0.25 * f64::from(x % 16))).collect(),
            depth: length(*depth),
        },
    };
    let mut at = piece.at.map(|x| 0.25 * f64::from(x % 16));
    at[usize::from(piece.nudge.0 % 3)] += match piece.nudge.1 % 16 {
        0..=7 => 0.0,
        n => 10f64.powi(-i32::from(n)) * if piece.nudge.0 & 4 == 0 { 1.0 } else { -1.0 },
    };
    let rotation_deg = piece.turn.map(|(axis, angle)| Rotation {
        axis: axis.map(f64::from),
        angle: f64::from(angle % 360) * 0.5,
    });
    BlockSpec { at, rotation_deg, support: k == 0, ..BlockSpec::new(format!("b{k}"), shape) }
}

fuzz_target!(|pieces: [Piece; 3]| {
    let mut scene = Scene::default();
    scene.joints.default.friction = Some(Friction::Coefficient(0.6));
    scene.blocks = pieces.iter().enumerate().map(|(k, p)| block(k, p)).collect();
    if let Ok(model) = prepare(&scene) {
        voussoir_fuzz::sound(&model);
        // Blocks in another order touch as often.
        scene.blocks.reverse();
        if let Ok(again) = prepare(&scene) {
            assert_eq!(
                again.interfaces.list.len(),
                model.interfaces.list.len(),
                "contacts depend on the order of the blocks"
            );
        }
    }
});
