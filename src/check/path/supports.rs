//! Which supports a question moves, and how far.

use super::{Drive, Move, Moves};
use crate::{
    question::{PushOptions, SettleOptions, SupportMove},
    verdict::tilted::unit,
};
use base::{
    error::{InputError, JsonPath},
    tolerance,
};
use model::assembly::Assembly;
use nalgebra::Vector3;
use scene::fits;

impl Drive {
    /// The supports that a question moves.
    ///
    /// # Errors
    /// A name that fits no support, a support that is told to move twice, a way outwards where there
    /// is no outwards.
    pub fn settle(assembly: &Assembly, options: &SettleOptions) -> Result<Self, InputError> {
        Ok(Self::Settle(Moves(moves(assembly, &options.moves)?)))
    }

    /// The point that a question pushes.
    ///
    /// # Errors
    /// No such free block, or no point of it.
    pub fn push(assembly: &Assembly, options: &PushOptions) -> Result<Self, InputError> {
        let blocks = &assembly.blocks;
        let id = &options.control.block;
        let Some(block) = assembly.find(id).filter(|&i| !blocks[i].support) else {
            return Err(error(format!("{id}: there is no such free block")));
        };
        let point = Vector3::from(options.control.point);
        if (point - blocks[block].centroid).norm() > blocks[block].size {
            let c: [f64; 3] = blocks[block].centroid.into();
            return Err(error(format!("the control point does not lie on {id}"))
                .hint(format!("its centre of mass is at {}", base::number::point(c))));
        }
        Ok(Self::Push { block, point, toward: unit(options.toward.into()) })
    }
}

/// The ways of supports, in the order in which they are named.
fn moves(assembly: &Assembly, asked: &[SupportMove]) -> Result<Vec<Move>, InputError> {
    let blocks = &assembly.blocks;
    let mut moves: Vec<Move> = Vec::new();
    for m in asked {
        let fitting = |&i: &usize| blocks[i].support && fits(&m.support, &blocks[i].id);
        let named: Vec<usize> = (0..blocks.len()).filter(fitting).collect();
        if named.is_empty() {
            let supports: Vec<&str> =
                blocks.iter().filter(|b| b.support).map(|b| b.id.as_str()).take(8).collect();
            return Err(error(format!("{}: there is no such support", m.support))
                .hint(format!("supports are {}", supports.join(", "))));
        }
        let outwards = if m.out == 0.0 {
            vec![Vector3::zeros(); named.len()]
        } else {
            outwards(assembly, &named, &m.support)?
        };
        for (support, outwards) in named.into_iter().zip(outwards) {
            if moves.iter().any(|other| other.support == support) {
                let text = format!("{}: two movements are given", blocks[support].id);
                return Err(error(text).hint("name each support once, by its id or by a pattern"));
            }
            moves.push(Move {
                support,
                way: Vector3::from(m.way) + m.out * outwards,
                turn: Vector3::from(m.turn_deg).map(f64::to_radians),
            });
        }
    }
    Ok(moves)
}

/// The horizontal unit directions away from the mean of the centres of mass of some supports.
fn outwards(
    assembly: &Assembly,
    named: &[usize],
    name: &str,
) -> Result<Vec<Vector3<f64>>, InputError> {
    let blocks = &assembly.blocks;
    if let [only] = named {
        return Err(error(format!("{}: `out` is undefined for a single support", blocks[*only].id))
            .hint(format!(
                "name several by a pattern, such as \"{name}*\", or give the displacement as three numbers"
            )));
    }
    let up = -assembly.gravity.try_normalize(0.0).unwrap_or(-Vector3::z());
    let all: Vector3<f64> = named.iter().map(|&i| blocks[i].centroid).sum();
    let middle = all / named.len() as f64;
    let arm = |i: usize| blocks[i].centroid - middle;
    let reach = named.iter().map(|&i| arm(i).norm().max(blocks[i].size)).fold(0.0, f64::max);
    let direction = |&i: &usize| {
        let flat = arm(i) - up * up.dot(&arm(i));
        if flat.norm() > tolerance::AT_MIDDLE * reach {
            return Ok(flat.normalize());
        }
        let id = &blocks[i].id;
        Err(error(format!(
            "{id}: `out` is undefined at the centre of the supports that move outwards ({name})"
        ))
        .hint("name only the supports around it, or give the displacements as three numbers"))
    };
    named.iter().map(direction).collect()
}

fn error(text: String) -> InputError {
    InputError::at(JsonPath::root(), text)
}
