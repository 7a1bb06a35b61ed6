//! Random scenes and their images: mirrored, a thousand times as large, moved, renamed in another
//! order, and asked for points on the way. Of every question the answer is one: the same verdict, the
//! same number. What is saved is what its check accepts.

use super::{random::Random, soak::FAILED};
use analysis::{
    Control, ControlPoint, CriticalOptions, Law, LimitOptions, PushOptions, Question,
    SettleOptions, SupportMove, TiltOptions, ask, recompute::Solvers, saved,
};
use base::error::{InputError, RowsError};
use check::proof::{
    answer::{Answer, FactorStatus},
    read::read_str,
    verify::verify_model,
};
use model::interface::prepare;
use nalgebra::Vector3;
use report::{
    json,
    text::{Layout, Page, Role},
};
use scene::{
    BlockSpec, Friction, Load, Material, Scene, Shape, Template,
    generate::expand,
    template::{Arch, Wall, WallBase, WallEnd},
};
use serde::{Deserialize, Serialize};
use serde_json::json;
use solve::deadline::Deadline;
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
    time::Instant,
};
use sweep::keep::{Kept, Numbered, numbered};

/// The kinds of structures, in the order of the table.
pub const FAMILIES: [&str; 3] = ["stack", "arch", "wall"];

/// The images of a scene.
pub const IMAGES: [&str; 4] = ["mirrored", "a thousand times as large", "moved", "renamed"];

/// The questions.
pub const QUESTIONS: [&str; 6] = ["assess", "limit", "tilt", "critical", "push", "settle"];

/// Numbers that are proved differ by no more than this × what they are.
const SAME: f64 = 1e-6;
/// Numbers with dry friction, which are computed, likewise.
const DRY: f64 = 1e-3;
/// A question may take so many seconds; more counts as undecided.
const SECONDS: f64 = 60.0;

/// An answer in one word and its numbers; nothing where it is undecided.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Said {
    /// The question, by its place in [`QUESTIONS`].
    pub question: usize,
    /// The answer.
    pub word: Option<String>,
    /// Its numbers, and by how much of them they may be off.
    pub numbers: Vec<(f64, f64)>,
    /// Why a path is open.
    pub why: Option<String>,
}

/// What came of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Alike {
    /// Its number.
    pub index: usize,
    /// Its family.
    pub family: String,
    /// Its own answers.
    pub own: Vec<Said>,
    /// Answers of images that were held against them.
    pub compared: usize,
    /// Of those, how many are open on one side alone.
    pub open: usize,
    /// What cannot be.
    pub wrong: Vec<String>,
    /// Why it was refused, or that the program failed.
    pub error: Option<String>,
    /// Seconds of the slowest question.
    pub slowest: f64,
}

impl Numbered for Alike {
    fn number(&self) -> usize {
        self.index
    }
}

impl Alike {
    /// A contradiction, or a failure of the program.
    pub fn is_wrong(&self) -> bool {
        !self.wrong.is_empty() || self.error.as_deref().is_some_and(|e| e.starts_with(FAILED))
    }
}

/// The file in which the scenes of a seed are kept.
///
/// # Errors
/// As [`Kept::open`].
pub fn keep(path: &Path, seed: u64) -> Result<Kept<Alike>, RowsError> {
    Kept::open(path, "voussoir-alike/1", json!({ "seed": seed }))
}

/// Asks scenes number 0 to `count`, on all threads, but for those that are kept already.
///
/// # Errors
/// Threads cannot be started, or the file cannot be written.
pub fn run(
    seed: u64,
    count: usize,
    kept: Option<&Kept<Alike>>,
    each: impl Fn(&Alike) + Sync,
) -> Result<Vec<Alike>, RowsError> {
    numbered(count, kept, |index| one(seed, index), each)
}

/// Scene number `index` of a seed: up to a dozen blocks in the x–z plane under a load sideways.
///
/// # Errors
/// A template refused its values, which would be a mistake in this file.
pub fn scene(seed: u64, index: usize) -> Result<(Scene, &'static str), InputError> {
    let random = &mut Random::of(seed, index);
    let family = FAMILIES[index % FAMILIES.len()];
    let blocks = match family {
        "arch" => expand(&Template::Arch(Arch {
            radius: Some(1.0),
            thickness: random.between(0.12, 0.4),
            depth: 1.0,
            embrace_deg: Some(random.between(110.0, 175.0)),
            voussoirs: random.count(3, 9),
            ..Arch::default()
        }))?,
        "wall" => expand(&Template::Wall(Wall {
            size: [1.0, 0.5, random.between(0.4, 0.9)],
            courses: random.count(1, 3),
            blocks: random.count(2, 3),
            first: if random.chance(0.5) { WallEnd::Whole } else { WallEnd::Half },
            base: WallBase::Slab,
            ..Wall::default()
        }))?,
        _ => stack(random),
    };
    let mut scene =
        Scene { name: format!("alike {seed}/{index}: {family}"), blocks, ..Scene::default() };
    let friction = [0.3, 0.5, 0.7, 1.0][random.count(0, 3)] * random.between(0.95, 1.05);
    scene.joints.default.friction = Some(match random.chance(0.2) {
        true => Friction::Infinite,
        false => Friction::Coefficient(friction),
    });
    scene.materials.insert("stone".into(), Material::of_density(2000.0));
    scene.blocks.iter_mut().for_each(|b| b.material = Some("stone".into()));
    let weight = Some([if random.chance(0.5) { 1.0 } else { -1.0 }, 0.0, 0.0]);
    scene.loads.live.push(Load { weight, ..Load::default() });
    Ok((scene, family))
}

fn stack(random: &mut Random) -> Vec<BlockSpec> {
    let cuboid = |size: [f64; 3]| Shape::Cuboid { size };
    let mut list = vec![BlockSpec {
        support: true,
        at: [0.0, 0.0, -0.5],
        ..BlockSpec::new("base", cuboid([random.between(3.0, 40.0), 4.0, 1.0]))
    }];
    let (mut x, mut z) = (random.between(-1.0, 1.0), 0.0);
    for k in 0..random.count(1, 4) {
        let size = [random.between(0.5, 1.5), 1.0, random.between(0.3, 1.2)];
        list.push(BlockSpec {
            at: [x, 0.0, z + 0.5 * size[2]],
            ..BlockSpec::new(format!("b{k}"), cuboid(size))
        });
        z += size[2];
        x += 0.15 * random.between(-1.0, 1.0);
    }
    list
}

/// Where a point, or a way, of a scene comes to in one of its [`IMAGES`].
fn at(image: usize, p: [f64; 3], is_way: bool) -> [f64; 3] {
    let moved = if is_way { [0.0; 3] } else { [700.0, -300.0, 60.0] };
    match image {
        0 => [-p[0], p[1], p[2]],
        1 => p.map(|x| 1e3 * x),
        2 => [p[0] + moved[0], p[1] + moved[1], p[2] + moved[2]],
        _ => p,
    }
}

/// What a block is called in one of the [`IMAGES`].
fn named(image: usize, id: &str) -> String {
    if image == 3 { format!("x{}", id.chars().rev().collect::<String>()) } else { id.into() }
}

/// One of the [`IMAGES`] of a scene.
fn image(scene: &Scene, image: usize) -> Scene {
    let mut scene = scene.clone();
    for block in &mut scene.blocks {
        block.id = named(image, &block.id);
        block.at = at(image, block.at, false);
        match &mut block.shape {
            Shape::Cuboid { size } if image == 1 => *size = at(1, *size, true),
            Shape::Prism { polygon, depth } => {
                let flat = |p: [f64; 2]| at(image, [p[0], 0.0, p[1]], true);
                polygon.iter_mut().for_each(|p| *p = [flat(*p)[0], flat(*p)[2]]);
                *depth = if image == 1 { 1e3 * *depth } else { *depth };
            }
            _ => {}
        }
    }
    for load in &mut scene.loads.live {
        load.weight = load.weight.map(|w| if image == 0 { at(0, w, true) } else { w });
    }
    if image == 3 {
        scene.blocks.reverse();
    }
    scene
}

/// The questions about a scene, those of paths drawn by chance.
fn questions(scene: &Scene, random: &mut Random) -> Vec<Question> {
    let free: Vec<&BlockSpec> = scene.blocks.iter().filter(|b| !b.support).collect();
    let held: Vec<&BlockSpec> = scene.blocks.iter().filter(|b| b.support).collect();
    let block = free[random.count(0, free.len() - 1)];
    let support = held[random.count(0, held.len() - 1)];
    let toward = scene.loads.live[0].weight.unwrap_or_default();
    let sign = if random.chance(0.5) { 1.0 } else { -1.0 };
    let moves = match held.len() {
        1 => SupportMove {
            turn_deg: [0.0, sign * 50.0, 0.0],
            ..SupportMove::along(&support.id, [0.0; 3])
        },
        _ => SupportMove::along(&support.id, [sign * random.between(0.2, 1.0), 0.0, 0.0]),
    };
    let control = ControlPoint { block: block.id.clone(), point: middle(block).into() };
    vec![
        Question::Assess(Default::default()),
        Question::Limit(LimitOptions { skip_dead: true, ..LimitOptions::default() }),
        Question::Tilt(TiltOptions {
            toward: vec![toward],
            skip_dead: true,
            law: Law::Associative,
            ..TiltOptions::default()
        }),
        Question::Critical(CriticalOptions {
            law: Law::Coulomb,
            vary: "/joints/default/friction".into(),
            between: [0.05, 1.1],
            scan: Some(6),
        }),
        Question::Push(PushOptions { control, toward, at: Vec::new(), from: Vec::new() }),
        Question::Settle(SettleOptions { moves: vec![moves], ..SettleOptions::default() }),
    ]
}

/// The middle of what there is of a block.
pub(crate) fn middle(block: &BlockSpec) -> Vector3<f64> {
    let own = match &block.shape {
        Shape::Prism { polygon, .. } => {
            let sum = polygon.iter().fold([0.0; 2], |s, p| [s[0] + p[0], s[1] + p[1]]);
            let count = polygon.len() as f64;
            Vector3::new(sum[0] / count, 0.0, sum[1] / count)
        }
        _ => Vector3::zeros(),
    };
    own + Vector3::from(block.at)
}

/// The same question about one of the [`IMAGES`].
fn of_image(question: &Question, image: usize) -> Question {
    let mut question = question.clone();
    let way = |w: [f64; 3]| if image == 0 { at(0, w, true) } else { w };
    match &mut question {
        Question::Tilt(o) => o.toward.iter_mut().for_each(|w| *w = way(*w)),
        Question::Push(o) => {
            o.control.block = named(image, &o.control.block);
            o.control.point = at(image, o.control.point, false);
            o.toward = way(o.toward);
        }
        Question::Settle(o) => {
            for m in &mut o.moves {
                m.support = named(image, &m.support);
                m.way = at(image, m.way, true);
                // A turn is a turn about an axis: its mirror image turns the other way.
                m.turn_deg = m.turn_deg.map(|t| if image == 0 { -t } else { t });
            }
        }
        _ => {}
    }
    question
}

/// What is answered, and whether its own check accepts it.
fn answered(
    scene: &Scene,
    questions: &[Question],
    slowest: &mut f64,
) -> Result<Vec<(Said, Option<String>)>, InputError> {
    let model = prepare(scene)?;
    let mut list = Vec::new();
    for (k, question) in questions.iter().enumerate() {
        let begin = Instant::now();
        let control = Control { deadline: Deadline::within(SECONDS), ..Control::default() };
        let answer = ask(question, scene, &model, &control)?;
        let file = saved::of(question, scene, &model, &answer)?;
        *slowest = slowest.max(begin.elapsed().as_secs_f64());
        let text = json::pretty(&file).unwrap_or_default();
        let fails = match read_str("result", text.as_str()) {
            Ok(read) => {
                let found = verify_model(&read, scene, &model, &Solvers::default());
                let parts = found.parts.iter().flat_map(|(_, f)| &f.fails);
                found.refuted().then(|| parts.cloned().collect::<Vec<_>>().join(", "))
            }
            Err(e) => Some(e.to_string()),
        };
        list.push((Said { why: file.run.why.path.clone(), ..said(k, &file.answer) }, fails));
    }
    Ok(list)
}

fn said(question: usize, answer: &Answer) -> Said {
    let open = Said { question, word: None, numbers: Vec::new(), why: None };
    let found = |word: &str, numbers: Vec<(f64, f64)>| Said {
        question,
        word: Some(word.into()),
        numbers,
        why: None,
    };
    if let Some(path) = answer.path() {
        use check::proof::path::PathStatus::{Falls, Open, Reached, Slides, Vanishes};
        return match (path.status, path.value) {
            (Falls | Vanishes, Some(v)) => found("ends", vec![(v, SAME)]),
            (Reached, _) => found("reached", Vec::new()),
            (Falls | Vanishes | Slides | Open, _) => open,
        };
    }
    if let Some(list) = answer.critical() {
        let between = |low: f64, high: f64| (0.5 * (low + high), 0.6 * (high - low) + 1e-3);
        let turns: Vec<String> =
            list.iter().map(|c| format!("{:?} {:?}", c.below, c.above)).collect();
        let numbers = list.iter().map(|c| between(c.lower, c.upper)).collect();
        return found(&turns.join(", "), numbers);
    }
    if let Some(l) = answer.load_factor() {
        return match (l.status, l.value) {
            (FactorStatus::Found, Some(v)) => {
                let bound = l.associative.upper.filter(|b| (b - v).abs() <= SAME * v.abs());
                found("found", vec![(v, if bound.is_some() { 1e-5 } else { DRY })])
            }
            (FactorStatus::Unbounded, _) => found("without limit", Vec::new()),
            (FactorStatus::Impossible, _) => found("impossible", Vec::new()),
            _ => open,
        };
    }
    use check::verdict::Verdict::{Conditional, Stable, Undecided, Unstable};
    match answer.verdict() {
        Some(Stable) => found("stands", Vec::new()),
        Some(Conditional) => found("self-stress", Vec::new()),
        Some(Unstable) => found("falls", Vec::new()),
        Some(Undecided) | None => open,
    }
}

/// Asks one scene and its images.
pub fn one(seed: u64, index: usize) -> Alike {
    let mut alike = Alike {
        index,
        family: FAMILIES[index % FAMILIES.len()].into(),
        own: Vec::new(),
        compared: 0,
        open: 0,
        wrong: Vec::new(),
        error: None,
        slowest: 0.0,
    };
    let asked = catch_unwind(AssertUnwindSafe(|| asked(seed, &mut alike)));
    match asked {
        Ok(Ok(())) => {}
        Ok(Err(e)) => alike.error = Some(e.to_string()),
        Err(_) => alike.error = Some(format!("{FAILED} on this scene")),
    }
    alike
}

fn asked(seed: u64, alike: &mut Alike) -> Result<(), InputError> {
    let (scene, _) = scene(seed, alike.index)?;
    let questions = questions(&scene, &mut Random::apart(seed, alike.index));
    let own = answered(&scene, &questions, &mut alike.slowest)?;
    let refused = |list: &[(Said, Option<String>)], of: &str| -> Vec<String> {
        let refused = list.iter().filter_map(|(s, why)| Some((s, why.as_ref()?)));
        refused.map(|(s, why)| format!("{} {of}: refuted, {why}", QUESTIONS[s.question])).collect()
    };
    alike.wrong.extend(refused(&own, "of the scene"));
    let own: Vec<Said> = own.into_iter().map(|(said, _)| said).collect();
    for (k, name) in IMAGES.iter().enumerate() {
        let there: Vec<Question> = questions.iter().map(|q| of_image(q, k)).collect();
        let there = answered(&image(&scene, k), &there, &mut alike.slowest)?;
        alike.wrong.extend(refused(&there, name));
        // The way of a control point is as long as the scene is large.
        let length = |s: &Said| if k == 1 && QUESTIONS[s.question] == "push" { 1e3 } else { 1.0 };
        let there = there.into_iter().map(|(said, _)| said);
        hold(alike, &own, there, name, &length);
    }
    // Points that are asked for on the way change nothing.
    let share = |v: f64| vec![0.371 * v, 0.683 * v];
    let on_the_way: Vec<Question> = questions
        .iter()
        .zip(&own)
        .map(|(q, said)| {
            let mut q = q.clone();
            match (&mut q, said.numbers.first()) {
                (Question::Push(o), Some((v, _))) if *v > 0.0 => o.at = share(*v),
                (Question::Settle(o), Some((v, _))) if *v > 0.0 => o.at = share(*v),
                _ => {}
            }
            q
        })
        .collect();
    let [.., push, settle] = &on_the_way[..] else { return Ok(()) };
    let again = answered(&scene, &[push.clone(), settle.clone()], &mut alike.slowest)?;
    let first = own.len() - again.len();
    let again: Vec<_> = again
        .into_iter()
        .map(|(s, why)| (Said { question: s.question + first, ..s }, why))
        .collect();
    alike.wrong.extend(refused(&again, "with --at"));
    let again = again.into_iter().map(|(said, _)| said);
    hold(alike, &own[first..], again, "with --at", &|_| 1.0);
    alike.own = own;
    Ok(())
}

/// Holds answers against those of the scene itself.
fn hold(
    alike: &mut Alike,
    own: &[Said],
    there: impl Iterator<Item = Said>,
    name: &str,
    length: &dyn Fn(&Said) -> f64,
) {
    for (here, there) in own.iter().zip(there) {
        alike.compared += 1;
        let (Some(word), Some(other)) = (&here.word, &there.word) else {
            alike.open += usize::from(here.word.is_some() != there.word.is_some());
            continue;
        };
        let off = here.numbers.iter().zip(&there.numbers).any(|((a, by), (b, _))| {
            let b = b / length(here);
            (a - b).abs() > by * a.abs().max(b.abs()).max(1e-3)
        });
        if word != other || off {
            let tell = |s: &Said| format!("{:?} {:?}", s.word, s.numbers);
            alike.wrong.push(format!(
                "{} {name}: {} instead of {}",
                QUESTIONS[here.question],
                tell(&there),
                tell(here)
            ));
        }
    }
}

/// The scenes as a page: sums by family, then what is not as it should be.
pub fn text(list: &[Alike], seed: u64, verbose: bool, layout: Layout) -> Page {
    const NAMED: usize = 8;
    let mut page = Page::new(layout);
    let wrong: Vec<&Alike> = list.iter().filter(|e| e.is_wrong()).collect();
    let role = if wrong.is_empty() { Role::Good } else { Role::Bad };
    page.title(
        "Scenes and their images",
        format!("{} scenes, {} with a contradiction", list.len(), wrong.len()),
        role,
    );
    page.blank();
    for family in FAMILIES {
        page.row(family, [sums(list, |e| e.family == family)]);
    }
    page.row("all", [sums(list, |_| true)]);
    let decided = QUESTIONS.iter().enumerate().map(|(k, question)| {
        let asked = list.iter().filter_map(|e| e.own.get(k));
        let open = asked.clone().filter(|s| s.word.is_none()).count();
        format!("{question}: {} asked, {open} open", asked.count())
    });
    page.row("questions", decided);
    let shown = if verbose { wrong.len() } else { wrong.len().min(NAMED) };
    if verbose {
        let own = list.iter().flat_map(|e| e.own.iter().map(move |s| (e, s)));
        let open = own.filter(|(_, s)| s.word.is_none());
        page.row(
            "open",
            open.map(|(e, s)| {
                let why = s.why.as_deref().unwrap_or("undecided");
                format!("{seed}/{}: {} {}: {why}", e.index, e.family, QUESTIONS[s.question])
            }),
        );
    }
    page.row("wrong", wrong[..shown].iter().map(|e| line(e, seed)));
    page.row("refused", list.iter().filter(|e| e.error.is_some()).map(|e| line(e, seed)));
    page
}

fn sums(list: &[Alike], of: impl Fn(&Alike) -> bool) -> String {
    let own = || list.iter().filter(|e| of(e));
    format!(
        "{} scenes, {} answers of images held against those of the scene, {} open on one side alone; the slowest question {:.1} s",
        own().count(),
        own().map(|e| e.compared).sum::<usize>(),
        own().map(|e| e.open).sum::<usize>(),
        own().map(|e| e.slowest).fold(0.0, f64::max),
    )
}

fn line(e: &Alike, seed: u64) -> String {
    let what = e.error.clone().unwrap_or_else(|| e.wrong.join("; "));
    format!("{seed}/{}: {}: {what}", e.index, e.family)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_of_scenes_answer_as_the_scene() {
        let list = run(1, 12, None, |_| {}).unwrap();
        let wrong: Vec<_> = list.iter().filter(|e| e.is_wrong()).collect();
        assert!(wrong.is_empty(), "{wrong:#?}");
        assert!(list.iter().map(|e| e.compared).sum::<usize>() > 200, "{list:#?}");
    }

    #[test]
    fn another_number_or_word_is_wrong() {
        let said = |word: &str, v: f64| Said {
            question: 1,
            word: Some(word.into()),
            numbers: vec![(v, SAME)],
            why: None,
        };
        let wrong = |there: Said| {
            let mut alike = one(1, 0);
            alike.wrong.clear();
            hold(&mut alike, &[said("found", 0.5)], std::iter::once(there), "moved", &|_| 1.0);
            alike.is_wrong()
        };
        assert!(!wrong(said("found", 0.5)));
        assert!(wrong(said("found", 0.50001)) && wrong(said("impossible", 0.5)));
    }
}
