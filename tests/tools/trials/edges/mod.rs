//! Random scenes whose blocks meet at edges and corners, each beside the same scene with flats of
//! [`WIDTHS`] there: its load factor must lie between the ends that are told, and go to the one with
//! edges flattened as the flats go to nothing.

mod scenes;

pub use scenes::{FAMILIES, scene};

use analysis::{Control, Law, assess, limit};
use base::{error::RowsError, plane::polygon};
use check::{terms::Outcome, verdict::Verdict};
use model::interface::{Interface, Model, prepare};
use nalgebra::{Vector2, Vector3};
use parry3d::{math::Vector, transformation::try_convex_hull};
use report::text::{Layout, Page, Role};
use scene::{Scene, Shape};
use serde::{Deserialize, Serialize};
use serde_json::json;
use solve::deadline::Deadline;
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
    time::Instant,
};
use sweep::keep::{Kept, Numbered, numbered};

/// Widths of the flats, m; blocks are about a metre large.
pub const WIDTHS: [f64; 3] = [1e-3, 1e-4, 1e-5];
/// A load factor changes by no more than this × the width of the flats, 1/m.
const SLOPE: f64 = 300.0;
/// A scene may take so many seconds; more counts as undecided.
const SECONDS: f64 = 60.0;

/// What is known of a scene: whether it stands, and its load factor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Known {
    /// The verdict under its weight, by statics.
    pub verdict: Verdict,
    /// What became of the load factor.
    pub outcome: Outcome,
    /// Its ends, as far as they are finite.
    pub ends: [Option<f64>; 2],
}

/// What came of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Edged {
    /// Its number.
    pub index: usize,
    /// Its family.
    pub family: String,
    /// Edges and corners with several normals.
    pub touches: usize,
    /// Its answers.
    pub own: Option<Known>,
    /// Those with flats, in the order of [`WIDTHS`].
    pub flats: Vec<Known>,
    /// What contradicts them.
    pub wrong: Option<String>,
    /// Why it was refused, or that the program failed.
    pub error: Option<String>,
    /// Seconds.
    pub seconds: f64,
}

impl Numbered for Edged {
    fn number(&self) -> usize {
        self.index
    }
}

impl Edged {
    /// A contradiction, or a failure of the program.
    pub fn is_wrong(&self) -> bool {
        self.wrong.is_some() || self.error.as_deref().is_some_and(|e| e.starts_with(FAILED))
    }
}

/// How the error of a scene begins on which the program itself failed.
const FAILED: &str = "the program failed";

/// The file in which the scenes of a seed are kept.
///
/// # Errors
/// As [`Kept::open`].
pub fn keep(path: &Path, seed: u64) -> Result<Kept<Edged>, RowsError> {
    Kept::open(path, "voussoir-edges/1", json!({ "seed": seed }))
}

/// Asks scenes number 0 to `count`, on all threads, but for those that are kept already.
///
/// # Errors
/// Threads cannot be started, or the file cannot be written.
pub fn run(
    seed: u64,
    count: usize,
    kept: Option<&Kept<Edged>>,
    each: impl Fn(&Edged) + Sync,
) -> Result<Vec<Edged>, RowsError> {
    numbered(count, kept, |index| one(seed, index), each)
}

/// Asks one scene.
pub fn one(seed: u64, index: usize) -> Edged {
    let start = Instant::now();
    let family = FAMILIES[index % FAMILIES.len()].into();
    let mut edged = Edged {
        index,
        family,
        touches: 0,
        own: None,
        flats: Vec::new(),
        wrong: None,
        error: None,
        seconds: 0.0,
    };
    if catch_unwind(AssertUnwindSafe(|| ask(seed, index, &mut edged))).is_err() {
        edged.error = Some(format!("{FAILED} on this scene"));
    }
    edged.seconds = start.elapsed().as_secs_f64();
    edged
}

fn ask(seed: u64, index: usize, edged: &mut Edged) {
    let prepared = scene(seed, index).and_then(|(scene, _)| Ok((prepare(&scene)?, scene)));
    let (model, scene) = match prepared {
        Ok(both) => both,
        Err(e) => return edged.error = Some(e.to_string()),
    };
    edged.touches = model.interfaces.list.iter().filter(|f| !f.ways.is_empty()).count();
    let own = known(&model);
    edged.own = Some(own);
    for width in WIDTHS {
        let Some(flat) = flattened(&scene, &model, width) else { return };
        let Ok(flat) = prepare(&flat) else { return };
        // Where a flat pushes other contacts apart, it is another scene.
        let same = flat.interfaces.list.len() == model.interfaces.list.len()
            && flat.interfaces.list.iter().all(|f| f.ways.is_empty())
            && flat.interfaces.left_out.is_none();
        if !same {
            return;
        }
        let flat = known(&flat);
        edged.flats.push(flat);
    }
    edged.wrong = contradiction(&own, &edged.flats);
}

fn known(model: &Model) -> Known {
    let control = Control {
        law: Law::Associative,
        deadline: Deadline::within(SECONDS),
        ..Control::default()
    };
    let factor = limit(model, &control);
    let finite = |v: f64| v.is_finite().then_some(v);
    Known {
        verdict: assess(model, &control).verdict,
        outcome: factor.outcome,
        ends: match factor.outcome {
            Outcome::Impossible | Outcome::Unbounded => [None; 2],
            _ => [finite(factor.bracket.lower), finite(factor.bracket.upper)],
        },
    }
}

/// What is said of a scene that cannot be, if it goes with flats as these do.
fn contradiction(own: &Known, flats: &[Known]) -> Option<String> {
    let found = |k: &Known| k.ends[0].filter(|_| k.outcome == Outcome::Found);
    let [_, wider, at] = flats.iter().map(found).collect::<Option<Vec<_>>>()?[..] else {
        return None;
    };
    let width = WIDTHS[2];
    let is = |text: String| Some(format!("{text}, with flats of {width:.0e} m it is {at:.6}"));
    // As near as the narrowest flats allow, or ten times as near as wider ones.
    let apart = |v: f64| {
        let [off, before] = [at - v, wider - v].map(f64::abs);
        off > SLOPE * width * (1.0 + v.abs()) + 1e-6 && off > 0.2 * before
    };
    match (own.outcome, own.ends) {
        (Outcome::Impossible, _) => is("no λ is possible".into()),
        (Outcome::Unbounded, _) => is("λ has no limit".into()),
        (_, [_, Some(upper)]) if at > upper && apart(upper) => {
            is(format!("λ is at most {upper:.6}"))
        }
        // Across the middle of the normals: what the flats go to.
        (_, [Some(lower), _]) if apart(lower) => {
            is(format!("λ is {lower:.6} with edges flattened"))
        }
        _ => None,
    }
}

/// The scene with a flat of this width at every touch of several normals; nothing where a shape is
/// none that can have one.
fn flattened(scene: &Scene, model: &Model, width: f64) -> Option<Scene> {
    let mut scene = scene.clone();
    for touch in model.interfaces.list.iter().filter(|f| !f.ways.is_empty()) {
        for i in [touch.a, touch.b] {
            let shape = &mut scene.blocks[i].shape;
            match shape {
                Shape::Prism { polygon, .. } => {
                    let n = touch.frame.n;
                    let across = Vector2::new(-n.z, n.x).normalize() * (width / 2.0);
                    let at = Vector2::new(touch.points[0].x, touch.points[0].z);
                    let corners = polygon.iter().map(|&p| p.into());
                    let all: Vec<_> = corners.chain([at + across, at - across]).collect();
                    *polygon = polygon::hull(&all, 0.0).into_iter().map(Into::into).collect();
                }
                Shape::Polyhedron { vertices, faces } => {
                    let all = vertices.iter().map(|&v| v.into()).chain(patch(touch, width));
                    let all: Vec<_> =
                        all.map(|p: Vector3<f64>| Vector::new(p.x, p.y, p.z)).collect();
                    let (corners, triangles) = try_convex_hull(&all).ok()?;
                    *vertices = corners.iter().map(|c| [c.x, c.y, c.z]).collect();
                    *faces = triangles.iter().map(|t| t.map(|k| k as usize).to_vec()).collect();
                }
                _ => return None,
            }
        }
    }
    Some(scene)
}

/// The corners of a flat around a touch.
fn patch(touch: &Interface, width: f64) -> Vec<Vector3<f64>> {
    let [u, v] = [touch.frame.t1, touch.frame.t2].map(|t| t * (width / 2.0));
    touch.points.iter().flat_map(|p| [p + u + v, p + u - v, p - u + v, p - u - v]).collect()
}

/// The scenes as a page: sums by family, then what is not as it should be.
pub fn text(list: &[Edged], seed: u64, verbose: bool, layout: Layout) -> Page {
    const NAMED: usize = 8;
    let mut page = Page::new(layout);
    let wrong: Vec<&Edged> = list.iter().filter(|e| e.is_wrong()).collect();
    let role = if wrong.is_empty() { Role::Good } else { Role::Bad };
    page.title(
        "Edges and corners",
        format!("{} scenes, {} with a contradiction", list.len(), wrong.len()),
        role,
    );
    page.blank();
    for family in FAMILIES {
        page.row(family, [sums(list, |e| e.family == family)]);
    }
    page.row("all", [sums(list, |_| true)]);
    let shown = if verbose { wrong.len() } else { wrong.len().min(NAMED) };
    page.row("wrong", wrong[..shown].iter().map(|e| line(e, seed)));
    page.row("refused", list.iter().filter(|e| e.error.is_some()).map(|e| line(e, seed)));
    page
}

fn sums(list: &[Edged], of: impl Fn(&Edged) -> bool) -> String {
    let count = |what: &dyn Fn(&Edged) -> bool| list.iter().filter(|e| of(e) && what(e)).count();
    let own = |what: fn(&Known) -> bool| count(&|e| e.own.as_ref().is_some_and(what));
    format!(
        "{} scenes, {} with such touches, {} beside flats: {} stand, {} fall, {} undecided; load factors {} found, {} between two ends, {} undecided",
        count(&|_| true),
        count(&|e| e.touches > 0),
        count(&|e| e.flats.len() == WIDTHS.len()),
        own(|k| k.verdict == Verdict::Stable),
        own(|k| k.verdict == Verdict::Unstable),
        own(|k| k.verdict == Verdict::Undecided),
        own(|k| k.outcome == Outcome::Found),
        own(|k| k.outcome == Outcome::Undecided && k.ends.iter().all(Option::is_some)),
        own(|k| k.outcome == Outcome::Undecided && !k.ends.iter().all(Option::is_some)),
    )
}

fn line(e: &Edged, seed: u64) -> String {
    let what = e.wrong.as_ref().or(e.error.as_ref());
    format!("{seed}/{}: {}: {}", e.index, e.family, what.map_or("", String::as_str))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_with_edges_agree_with_the_same_with_flats() {
        let list = run(1, 60, None, |_| {}).unwrap();
        let wrong: Vec<_> = list.iter().filter(|e| e.is_wrong()).collect();
        assert!(wrong.is_empty(), "{wrong:#?}");
        let beside = list.iter().filter(|e| e.touches > 0 && e.flats.len() == WIDTHS.len());
        assert!(beside.count() > 15, "{list:#?}");
    }

    #[test]
    fn another_value_than_that_of_flats_is_wrong() {
        let flat =
            Known { verdict: Verdict::Stable, outcome: Outcome::Found, ends: [Some(0.5); 2] };
        let own = |lower, upper| Known {
            outcome: Outcome::Undecided,
            ends: [Some(lower), Some(upper)],
            ..flat
        };
        let wrong = |own: Known| contradiction(&own, &[flat; 3]).is_some();
        assert!(!wrong(own(0.5, 0.7)));
        assert!(wrong(own(0.3, 0.4)) && wrong(own(0.6, 0.7)) && wrong(own(0.4, 0.6)));
        assert!(wrong(Known { outcome: Outcome::Impossible, ..flat }));
    }
}
