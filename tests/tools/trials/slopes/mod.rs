//! Random scenes with derivatives of their load factor (`--sensitivity`), each held against
//! differences of load factors that are asked again with the number a little less and a little more:
//! one number where both sides agree, one a side where the load factor has a bend.

use super::{alike, random::Random, soak::FAILED};
use analysis::{Answer, Control, Law, LimitOptions, Question, ask, saved};
use base::error::{InputError, JsonPath, RowsError};
use check::terms::{Derivative, Origin};
use model::interface::prepare;
use report::text::{Layout, Page, Role};
use scene::{At, Friction, JointOverride, Load, Scene};
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
    time::Instant,
};
use sweep::keep::{Kept, Numbered, numbered};

/// Derivatives agree with differences up to this × themselves, where both sides of these do.
pub const SAME: f64 = 1e-4;
/// Differences on both sides that are as near to each other are one. Larger: bends are overlooked.
const ONE: f64 = 1e-3;
/// Numbers are changed by these × their scale, by half and by a quarter of it; what the difference has
/// to first order in it is taken away, twice, and the step counts at which both are nearer to each
/// other. Larger: a bend beside the number. Smaller: the last digits of load factors.
const STEPS: [f64; 3] = [4e-3, 1e-3, 2e-4];
/// Differences that are not known to this × themselves are none.
const KNOWN: f64 = 3e-5;
/// Derivatives that change a load factor by less than this × itself, where the number changes by its
/// scale, are rounding of the differences.
const NOTHING: f64 = 1e-5;

/// What came of a scene.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sloped {
    /// Its number.
    pub index: usize,
    /// Its family.
    pub family: String,
    /// Numbers whose derivative is the same on both sides and follows from the proof.
    pub one: usize,
    /// Numbers that were asked again.
    pub again: usize,
    /// Of these, numbers at which the load factor has a bend by the differences.
    pub bends: usize,
    /// Numbers that were not asked again.
    pub open: usize,
    /// Differences that did not come out.
    pub unknown: usize,
    /// The greatest error of a derivative, × itself.
    pub worst: f64,
    /// Seconds of the answer, and of what derivatives add to it.
    pub seconds: [f64; 2],
    /// What cannot be.
    pub wrong: Vec<String>,
    /// Why it was refused, or that the program failed.
    pub error: Option<String>,
}

impl Numbered for Sloped {
    fn number(&self) -> usize {
        self.index
    }
}

impl Sloped {
    /// A derivative that is none, or a failure of the program.
    pub fn is_wrong(&self) -> bool {
        !self.wrong.is_empty() || self.error.as_deref().is_some_and(|e| e.starts_with(FAILED))
    }
}

/// The file in which the scenes of a seed are kept.
///
/// # Errors
/// As [`Kept::open`].
pub fn keep(path: &Path, seed: u64) -> Result<Kept<Sloped>, RowsError> {
    Kept::open(path, "voussoir-slopes/1", json!({ "seed": seed }))
}

/// Asks scenes number 0 to `count`, on all threads, but for those that are kept already.
///
/// # Errors
/// Threads cannot be started, or the file cannot be written.
pub fn run(
    seed: u64,
    count: usize,
    kept: Option<&Kept<Sloped>>,
    each: impl Fn(&Sloped) + Sync,
) -> Result<Vec<Sloped>, RowsError> {
    numbered(count, kept, |index| one(seed, index), each)
}

/// Scene number `index` of a seed: one of [`alike::scene`] with loads on single blocks, joints of
/// their own and, by turns, mortar.
///
/// # Errors
/// As [`alike::scene`].
pub fn scene(seed: u64, index: usize) -> Result<(Scene, &'static str), InputError> {
    let (mut scene, family) = alike::scene(seed, index)?;
    let random = &mut Random::apart(seed, index);
    let spec = &mut scene.joints.default;
    if spec.friction == Some(Friction::Infinite) {
        spec.friction = Some(Friction::Coefficient(random.between(0.3, 0.9)));
    }
    if random.chance(0.4) {
        spec.cohesion = Some(random.between(500.0, 5e3));
        spec.tension = Some(random.between(100.0, 2e3));
    }
    if random.chance(0.2) {
        spec.compression = Some(random.between(3e5, 3e6));
    }
    let free: Vec<_> = scene.blocks.iter().filter(|b| !b.support).collect();
    let some = |random: &mut Random| free[random.count(0, free.len() - 1)];
    let (on, under) = (some(random), some(random));
    let middle = alike::middle(under);
    let place = [0, 1, 2].map(|k| middle[k] + [0.05, 0.0, 0.05][k] * random.between(-1.0, 1.0));
    let loads = [
        Load {
            block: Some(under.id.clone()),
            force: Some([0.0, 0.0, -random.between(1e3, 1e4)]),
            at: Some(At::Point(place)),
            ..Load::default()
        },
        Load {
            block: Some(on.id.clone()),
            force: Some([random.between(-1e4, 1e4), random.between(-1.0, 1.0) * 3e3, 0.0]),
            ..Load::default()
        },
    ];
    let [dead, live] = loads;
    let pair = scene.blocks.first().zip(scene.blocks.get(1));
    if let Some((a, b)) = pair.filter(|_| random.chance(0.5)) {
        let friction = Some(Friction::Coefficient(random.between(0.4, 0.9)));
        let blocks = Some([a.id.clone(), b.id.clone()]);
        scene.joints.overrides.push(JointOverride { blocks, friction, ..JointOverride::default() });
    }
    scene.loads.dead.push(dead);
    if random.chance(0.5) {
        scene.loads.live.push(live);
    }
    scene.name = format!("slopes {seed}/{index}: {family}");
    Ok((scene, family))
}

fn one(seed: u64, index: usize) -> Sloped {
    let caught = catch_unwind(AssertUnwindSafe(|| {
        let (scene, family) = scene(seed, index)?;
        let mut own = Sloped { index, family: family.into(), ..Sloped::default() };
        held(&scene, &mut own)?;
        Ok::<_, InputError>(own)
    }));
    let failed = |error: String| Sloped { index, error: Some(error), ..Sloped::default() };
    match caught {
        Ok(Ok(own)) => own,
        Ok(Err(e)) => failed(e.to_string()),
        Err(_) => failed(format!("{FAILED}it panicked")),
    }
}

/// Derivatives of a scene, held against differences.
fn held(scene: &Scene, own: &mut Sloped) -> Result<(), InputError> {
    let question = |sensitivity| {
        let options = LimitOptions { law: Law::Associative, ..LimitOptions::default() };
        Question::Limit(LimitOptions { sensitivity, ..options })
    };
    let (model, control) = (prepare(scene)?, Control::default());
    let start = Instant::now();
    let answer = ask(&question(false), scene, &model, &control)?;
    let asked = Instant::now();
    drop(saved::of_question(&question(false), scene, &model, &answer, &control)?);
    let without = asked.elapsed().as_secs_f64();
    own.seconds[0] = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let file = saved::of_question(&question(true), scene, &model, &answer, &control)?;
    own.seconds[1] = start.elapsed().as_secs_f64() - without;
    let Some(found) = &file.sensitivity else { return Ok(()) };
    let Some(value) = value_of(&answer) else { return Ok(()) };
    for d in &found.numbers {
        let scale = match d.unit {
            "m" => 1.0,
            _ => d.value.abs(),
        };
        match d.origin {
            Origin::Proof => own.one += 1,
            Origin::AskedAgain => own.again += 1,
            Origin::NotAsked => {
                own.open += 1;
                continue;
            }
        }
        let side = |sign: f64| {
            let by = |step: f64| {
                let changed = scene.with_field(&d.pointer, d.value + sign * step * scale)?;
                let model = prepare(&changed)?;
                let options = LimitOptions { law: Law::Associative, ..LimitOptions::default() };
                let alone = LimitOptions { skip_dead: true, ..options };
                let answer = ask(&Question::Limit(alone), &changed, &model, &control)?;
                let other = value_of(&answer)
                    .ok_or_else(|| InputError::at(JsonPath::root(), "no load factor beside it"))?;
                Ok::<_, InputError>((other - value) / (sign * step * scale))
            };
            let twice = |step: f64| {
                let [a, b, c] = [1.0, 0.5, 0.25].map(|share| by(share * step).ok());
                Some([2.0 * b? - a?, 2.0 * c? - b?])
            };
            let known = STEPS.iter().filter_map(|step| twice(*step));
            known.min_by(|x, y| (x[0] - x[1]).abs().total_cmp(&(y[0] - y[1]).abs()))
        };
        let nothing = NOTHING * value.abs() / scale;
        let is_known = |d: &[f64; 2]| (d[0] - d[1]).abs() <= KNOWN * d[0].abs().max(nothing / SAME);
        let [Some(left), Some(right)] = [-1.0, 1.0].map(|sign| side(sign).filter(is_known)) else {
            own.unknown += 1;
            continue;
        };
        let [left, right] = [left[1], right[1]];
        compare(own, d, [left, right], nothing);
    }
    Ok(())
}

/// A derivative beside differences on both sides.
fn compare(own: &mut Sloped, d: &Derivative, [left, right]: [f64; 2], nothing: f64) {
    let size = left.abs().max(right.abs()).max(nothing / SAME);
    let bend = (left - right).abs() > ONE * size;
    own.bends += usize::from(bend);
    let middle = 0.5 * (left + right);
    let of =
        |told: Option<f64>, there: f64| told.map_or(f64::INFINITY, |t| (t - there).abs() / size);
    let error = match bend {
        false => of(d.left, middle).max(of(d.right, middle)),
        true => of(d.left, left).max(of(d.right, right)),
    };
    own.worst = own.worst.max(error);
    if error > if bend { ONE } else { SAME } {
        own.wrong.push(format!(
            "{}: told {:?} and {:?} ({:?}), differences {left} and {right}",
            d.pointer, d.left, d.right, d.origin
        ));
    }
}

fn value_of(answer: &Answer) -> Option<f64> {
    match answer {
        Answer::Limit(l) => l.bound.found(),
        _ => None,
    }
}

/// What was found, for people.
pub fn text(list: &[Sloped], seed: u64, verbose: bool, layout: Layout) -> Page {
    let mut page = Page::new(layout);
    let wrong = list.iter().filter(|s| s.is_wrong()).count();
    let role = if wrong == 0 { Role::Good } else { Role::Bad };
    page.title(
        &format!("derivatives of load factors, seed {seed}"),
        format!("{} scenes, {wrong} with a derivative that is none", list.len()),
        role,
    );
    let sum = |of: &dyn Fn(&Sloped) -> usize| list.iter().map(of).sum::<usize>();
    page.row("numbers", [format!(
        "{} by the proof, {} asked again ({} bends), {} left open, {} without differences; worst error {:.1e}",
        sum(&|s| s.one),
        sum(&|s| s.again),
        sum(&|s| s.bends),
        sum(&|s| s.open),
        sum(&|s| s.unknown),
        list.iter().map(|s| s.worst).fold(0.0, f64::max)
    )]);
    let mut shares: [Vec<f64>; 2] = Default::default();
    for s in list.iter().filter(|s| s.one + s.again > 0) {
        shares[usize::from(s.again > 0)].push(s.seconds[1] / s.seconds[0]);
    }
    for (name, shares) in ["by the proof", "asked again"].into_iter().zip(&mut shares) {
        shares.sort_by(f64::total_cmp);
        if let Some(median) = shares.get(shares.len() / 2) {
            let most = shares[shares.len() - 1];
            page.row(
                "time",
                [format!(
                    "{name}: {} scenes, × the answer {median:.2} (median), {most:.2} (most)",
                    shares.len()
                )],
            );
        }
    }
    for s in list.iter().filter(|s| verbose || s.is_wrong()) {
        let said = s.error.iter().chain(&s.wrong).cloned();
        let line = format!("{}: {} {} {}", s.family, s.one, s.again, s.bends);
        page.row(&s.index.to_string(), std::iter::once(line).chain(said));
    }
    page
}
