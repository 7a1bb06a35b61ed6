//! Paths and their points.

use crate::follow::{
    End, Point,
    answer::{Followed, PointProof},
};
use check::{
    path::{Carried, saved::write_poses},
    proof::{
        certificate::Certificate,
        evidence::{EndEvidence, PathEvidence, PointEvidence},
    },
    verdict::{Evidence, Rate, claim::Findings, evidence::write_forces},
};
use model::interface::Model;
use std::sync::Arc;

/// A path as evidence.
pub fn path_evidence(model: &Model, followed: &Followed) -> PathEvidence {
    let carried = Carried::new(model);
    let path = &followed.path;
    let point = |p: &Point, proof: &PointProof| PointEvidence {
        value: p.value,
        poses: write_poses(&model.assembly, &p.poses),
        certificate: certificate(proof),
        bound: proof.bound.as_deref().map(certificate),
        motion: proof.motion.as_ref().map_or_else(Vec::new, |f| write_forces(&proof.model, f)),
    };
    let ends = match &path.end {
        End::Falls(list) => list.iter().zip(&followed.ends).map(|(p, f)| point(p, f)).collect(),
        _ => Vec::new(),
    };
    let pair = |k: usize| -> [String; 2] {
        let f = &carried.joints[k];
        [f.a, f.b].map(|i| model.assembly.blocks[i].id.clone())
    };
    let end = match &path.end {
        End::Reached => EndEvidence::Reached,
        End::Falls(_) if ends.len() == 2 => EndEvidence::Falls,
        End::Vanishes => EndEvidence::Vanishes,
        End::Slides(k) => EndEvidence::Slides(pair(*k)),
        End::Falls(_) | End::Stuck(_) => EndEvidence::Open,
    };
    let least = followed.least.as_ref().map(|(_, forces, rates)| {
        let own = rates.iter().zip(&model.assembly.blocks);
        let free: Vec<Rate> = own.map(|(r, b)| if b.support { Rate::zero() } else { *r }).collect();
        Certificate::new(model, None, Evidence::new(forces, &free), &Findings::default())
    });
    PathEvidence {
        points: path.points.iter().zip(&followed.proofs).map(|(p, f)| point(p, f)).collect(),
        ends: if end == EndEvidence::Falls { ends } else { Vec::new() },
        end,
        least,
    }
}

fn certificate(proof: &PointProof) -> Arc<Certificate> {
    let evidence = Evidence::new(&proof.forces, &proof.rates);
    Certificate::new(&proof.model, proof.claim, evidence, &proof.findings)
}
