//! Scene → assembly → interfaces, timed.

use super::{ContactFrame, Interface, Interfaces, axes, detect, detect_until, floating, tally};
use crate::assembly::{self, AppliedForce, Assembly, Blocks, Member};
use base::error::{Finding, FindingCode, InputError};
use nalgebra::Vector3;
use scene::Scene;
use serde::{Deserialize, Serialize};

/// Seconds per stage; a build without solvers has no clock, and leaves them at zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(default)]
pub struct Timings {
    /// Reading the file.
    pub read: f64,
    /// Resolving the scene.
    pub resolve: f64,
    /// Finding the interfaces.
    pub detect: f64,
    /// Building and solving programs, certificates included.
    pub solve: f64,
    /// Running the scene in time.
    pub simulate: f64,
    /// Verifying the answer from the scene once more before it is given.
    pub check: f64,
}

/// A scene made ready for questions.
#[derive(Clone, Debug)]
pub struct Model {
    /// The blocks and loads.
    pub assembly: Assembly,
    /// The contacts.
    pub interfaces: Interfaces,
    /// Seconds per stage so far.
    pub timings: Timings,
}

impl Model {
    /// An assembly with its interfaces, as they are.
    pub fn new(assembly: Assembly, interfaces: Interfaces) -> Self {
        Self { assembly, interfaces, timings: Timings::default() }
    }

    /// An assembly with its interfaces as they were detected; adds what they say together.
    pub fn detected(assembly: Assembly, interfaces: Interfaces) -> Self {
        let mut model = Self::new(assembly, interfaces);
        let said: Vec<Finding> = joints_open(&model)
            .into_iter()
            .chain(unheld(&model))
            .chain(without_effect(&model.interfaces))
            .chain(axes::mistake(&model))
            .collect();
        model.interfaces.findings.extend(said);
        model
    }

    /// The model of a scene that differs from that of this one in joints, loads and masses alone:
    /// where blocks touch is known.
    ///
    /// # Errors
    /// The scene cannot be resolved.
    pub fn alike(&self, scene: &Scene) -> Result<Self, InputError> {
        self.of_blocks(scene, assembly::resolve_blocks(scene)?)
    }

    /// The same where the blocks of the scene are known, too: combinations have them in common.
    ///
    /// # Errors
    /// As [`Self::alike`].
    pub fn of_blocks(&self, scene: &Scene, blocks: Blocks) -> Result<Self, InputError> {
        let assembly = assembly::resolve_with(scene, blocks)?;
        let interfaces = self.interfaces.with_joints_of(&assembly)?;
        Ok(Self::new(assembly, interfaces))
    }

    /// The same contacts under the dead load and this multiple of the live load, which no longer
    /// varies.
    #[must_use]
    pub fn at_load_factor(&self, lambda: f64) -> Self {
        Self::new(self.assembly.at_load_factor(lambda), self.interfaces.clone())
    }

    /// The same blocks and loads, with other contacts.
    #[must_use]
    pub fn with_interfaces(&self, interfaces: Interfaces) -> Self {
        Self { interfaces, ..Self::new(self.assembly.clone(), Interfaces::default()) }
    }

    /// The model without these blocks (as indices, in any order), their contacts and their loads.
    /// What is left touches as it did.
    #[must_use]
    pub fn without(&self, gone: &[usize]) -> Self {
        let blocks = self.assembly.blocks.len();
        let mut stays = vec![true; blocks];
        gone.iter().for_each(|&i| stays[i] = false);
        let mut place = vec![usize::MAX; blocks];
        let kept: Vec<usize> = (0..blocks).filter(|&i| stays[i]).collect();
        kept.iter().enumerate().for_each(|(own, &i)| place[i] = own);
        let of = &self.assembly;
        let forces = |list: &[AppliedForce]| -> Vec<AppliedForce> {
            list.iter()
                .filter(|a| stays[a.block])
                .map(|a| AppliedForce { block: place[a.block], ..*a })
                .collect()
        };
        let assembly = Assembly {
            blocks: kept.iter().map(|&i| of.blocks[i].clone()).collect(),
            dead: kept.iter().map(|&i| of.dead[i]).collect(),
            live: kept.iter().map(|&i| of.live[i]).collect(),
            dead_forces: forces(&of.dead_forces),
            live_forces: forces(&of.live_forces),
            // Contacts given by hand are among the interfaces already.
            given: Vec::new(),
            members: Vec::new(),
            name: of.name.clone(),
            gravity: of.gravity,
            joints: of.joints.clone(),
            contact: of.contact.clone(),
            said: Vec::new(),
            findings: of.findings.clone(),
        };
        let list = self.interfaces.list.iter().filter(|f| stays[f.a] && stays[f.b]);
        let list = list.map(|f| Interface { a: place[f.a], b: place[f.b], ..f.clone() }).collect();
        // A member goes with any of its blocks.
        let stay = |m: &&Member| m.action.ends().into_iter().flatten().all(|i| stays[i]);
        let members = self.interfaces.members.iter().filter(stay);
        let interfaces = Interfaces {
            list,
            members: members.map(|m| m.renumbered(&place)).collect(),
            support_pairs: self.interfaces.support_pairs,
            findings: self.interfaces.findings.clone(),
            left_out: self.interfaces.left_out,
            apart: self.interfaces.apart.clone(),
        };
        Self { timings: self.timings, ..Self::new(assembly, interfaces) }
    }

    /// The same with every flat also touching in each of its [ways](super::Interface::ways), behind
    /// the other contacts: at equal friction the forces of any normal between them are sums of
    /// theirs, and a motion that closes none of them closes no normal. Nothing where none is flat.
    pub fn every_way(&self) -> Option<Self> {
        let own = &self.interfaces.list;
        let one = |f: &Interface, n: &Vector3<f64>| {
            let frame = match f.points[..] {
                [p, q] => ContactFrame::along(*n, q - p),
                _ => ContactFrame::around(*n),
            };
            Interface { frame, ways: Vec::new(), ..f.clone() }
        };
        let more: Vec<Interface> =
            own.iter().flat_map(|f| f.ways.iter().map(|n| one(f, n))).collect();
        (!more.is_empty()).then(|| {
            let mut wide = self.clone();
            // All of its contacts have one normal.
            wide.interfaces.list.iter_mut().for_each(|f| f.ways.clear());
            wide.interfaces.list.extend(more);
            wide
        })
    }

    /// The same without flats; nothing where none is flat.
    pub fn without_flats(&self) -> Option<Self> {
        self.interfaces.list.iter().any(|f| !f.ways.is_empty()).then(|| {
            let mut less = self.clone();
            less.interfaces.list.retain(|f| f.ways.is_empty());
            less
        })
    }

    /// Ids of these blocks.
    pub fn ids(&self, blocks: &[usize]) -> Vec<String> {
        blocks.iter().map(|&i| self.assembly.blocks[i].id.clone()).collect()
    }

    /// Findings of every stage so far.
    pub fn findings(&self) -> impl Iterator<Item = &Finding> {
        self.assembly.said.iter().chain(self.own_findings())
    }

    /// Those that follow from the scene, whoever reads it.
    pub fn own_findings(&self) -> impl Iterator<Item = &Finding> {
        self.assembly.findings.iter().chain(&self.interfaces.findings)
    }

    /// Contact points of all interfaces.
    pub fn contact_points(&self) -> usize {
        self.interfaces.list.iter().map(|f| f.points.len()).sum()
    }
}

/// Resolves a scene and finds its interfaces.
///
/// # Errors
/// The scene cannot be resolved, or its contacts cannot be found.
pub fn prepare(scene: &Scene) -> Result<Model, InputError> {
    prepare_until(scene, &|| false)
}

/// The same, given up as soon as `is_over`: a deadline is past, somebody cancelled it.
///
/// # Errors
/// As [`prepare`], and where it was given up.
pub fn prepare_until(scene: &Scene, is_over: &dyn Fn() -> bool) -> Result<Model, InputError> {
    prepare_timed(scene, is_over, &|| 0.0)
}

/// The same with the time that each step took; `clock` says the seconds since any moment, which
/// nothing here knows by itself.
///
/// # Errors
/// As [`prepare_until`].
pub fn prepare_timed(
    scene: &Scene,
    is_over: &dyn Fn() -> bool,
    clock: &dyn Fn() -> f64,
) -> Result<Model, InputError> {
    let start = clock();
    let assembly = assembly::resolve_until(scene, is_over)?;
    let resolved = clock();
    let interfaces = detect_until(&assembly, is_over)?;
    let model = Model::detected(assembly, interfaces);
    let timings =
        Timings { resolve: resolved - start, detect: clock() - resolved, ..Timings::default() };
    Ok(Model { timings, ..model })
}

/// The same blocks and loads with the contacts closed that were left out; nothing where there are
/// none, or none of them can be closed.
///
/// # Errors
/// As [`detect`].
pub fn closed(model: &Model) -> Result<Option<Model>, InputError> {
    let spec = &model.assembly.contact;
    let Some(contact) = model.interfaces.left_out.and_then(|l| l.closing(spec)) else {
        return Ok(None);
    };
    let assembly = Assembly { contact, ..model.assembly.clone() };
    let interfaces = detect(&assembly)?;
    Ok(Some(Model::detected(assembly, interfaces)))
}

/// Joints drawn with their mortar, or with the gap of a saw: how wide such gaps are at most, × the
/// size of the smaller block. Larger: blocks across an opening are neighbours. Smaller: mortar of a
/// tenth of a brick is not known for what it is.
const WIDEST_JOINT: f64 = 0.1;
/// Scenes of more blocks are not searched for such joints.
const MOST_SEARCHED: usize = 20_000;

/// Says how wide the gaps are where most free blocks touch nothing and their neighbours stand off by
/// as much as each other.
fn joints_open(model: &Model) -> Option<Finding> {
    let Model { assembly, interfaces, .. } = model;
    let blocks = &assembly.blocks;
    let mut alone: Vec<bool> = blocks.iter().map(|b| !b.support && !b.solid.is_round()).collect();
    let free = alone.iter().filter(|a| **a).count();
    let ends = interfaces.members.iter().flat_map(|m| m.action.ends()).flatten();
    interfaces.list.iter().flat_map(|f| [f.a, f.b]).chain(ends).for_each(|i| alone[i] = false);
    let loose = alone.iter().filter(|a| **a).count();
    if 2 * loose <= free || blocks.len() > MOST_SEARCHED {
        return None;
    }
    let contact = scene::ContactSpec { gap: WIDEST_JOINT, ..assembly.contact.clone() };
    let wide = detect(&Assembly { contact, ..assembly.clone() }).ok()?;
    let size = |i: usize| if blocks[i].support { f64::INFINITY } else { blocks[i].size };
    // Gaps in m and × size, the narrowest first.
    let mut gaps: Vec<(f64, f64)> = wide
        .list
        .iter()
        .filter(|f| f.area > 0.0 && f.gap > 0.0 && (alone[f.a] || alone[f.b]))
        .map(|f| (f.gap, f.gap / size(f.a).min(size(f.b))))
        .collect();
    gaps.sort_by(|x, y| x.0.total_cmp(&y.0));
    let median = gaps.get(gaps.len() / 2)?.0;
    gaps.retain(|g| (0.5 * median..=1.5 * median).contains(&g.0));
    if 2 * gaps.len() < loose {
        return None;
    }
    let (least, greatest) = (gaps[0].0, gaps[gaps.len() - 1].0);
    let closes = tally::round_up(gaps.iter().map(|g| g.1).fold(0.0, f64::max));
    let width = match tally::short(least) == tally::short(greatest) {
        true => tally::short(least),
        false => format!("{} to {}", tally::short(least), tally::short(greatest)),
    };
    let text = format!(
        "{loose} of {free} free blocks touch nothing, and {} pairs of neighbours are {width} m apart, as in drawings with mortar joints: \"contact\": {{ \"gap\": {} }} (or --gap, on import) closes them",
        gaps.len(),
        tally::short(closes)
    );
    Some(Finding::new(FindingCode::Unjoined, text))
}

/// Says which free blocks nothing holds.
fn unheld(model: &Model) -> Option<Finding> {
    const NAMED: usize = 8;
    let loose: Vec<&str> = floating(model)
        .into_iter()
        .flatten()
        .map(|i| model.assembly.blocks[i].id.as_str())
        .collect();
    let more = loose.len().saturating_sub(NAMED);
    let names = loose[..loose.len() - more].join(", ");
    let text = match (loose.len(), more) {
        (0, _) => return None,
        (1, _) => format!("a free block has no contact path to a support: {names}"),
        (n, 0) => format!("{n} free blocks have no contact path to a support: {names}"),
        (n, more) => {
            format!("{n} free blocks have no contact path to a support: {names} and {more} more")
        }
    };
    Some(Finding::new(FindingCode::Floating, text))
}

/// Says what joints are given that their contacts cannot use: stresses need an area, a rolling arm
/// an edge or a point.
fn without_effect(interfaces: &Interfaces) -> Vec<Finding> {
    let count =
        |unused: &dyn Fn(&Interface) -> bool| interfaces.list.iter().filter(|f| unused(f)).count();
    let faces = count(&|f| f.law.rolling_arm > 0.0 && f.points.len() >= 3);
    let lines = count(&|f| f.points.len() < 3 && !f.law.friction_only());
    let mut findings = Vec::new();
    if faces > 0 {
        findings.push(format!(
            "{faces} contacts on faces have a rolling arm: not used, as the corners of a face already carry couples"
        ));
    }
    if lines > 0 {
        findings.push(format!(
            "{lines} contacts at edges or points have a strength, cohesion or pore pressure: not used, as they have no area"
        ));
    }
    findings.into_iter().map(|text| Finding::new(FindingCode::WithoutEffect, text)).collect()
}
