//! Why an answer is undecided: the most probable cause, what speaks for it, and the one thing to do
//! next.
//!
//! Causes are told from what is there once the answer is made: whether time was over, what the
//! check refused, how far the bracket closed, how wide the numbers of the scene are spread. The
//! first that fits is named, the most certain first.

use super::{
    Answer, Assessment, Control, Critical, Left, LoadFactor, Proved, Tilt, coulomb::DryLoadFactor,
    critical::Scanned, critical_value::Probe,
};
use base::{
    number::{count, rounded_down, short},
    tolerance,
};
use check::terms::{Fate, Stop};
use check::{
    terms::{Attempt, Doubt, DoubtCause, Found, Outcome, StateMotion},
    verdict::{Verdict, certificate},
};
use dynamics::SimulationOutcome;
use model::interface::Model;
use scene::Friction;

/// Why an answer, or the governing part of it, is undecided; nothing where it is decided.
pub fn doubt(answer: &Answer, model: &Model, control: &Control) -> Option<Doubt> {
    let about = About { model, late: control.deadline.is_set() && control.deadline.is_over() };
    match answer {
        Answer::Assess(a) => about.verdict(a),
        Answer::Limit(l) => about
            .bound(&l.bound)
            .or_else(|| {
                l.dry.as_ref().and_then(|dry| {
                    about.dry(
                        dry,
                        "simulate the load in question: `voussoir simulate` with --load-factor",
                    )
                })
            })
            .or_else(|| l.dead.as_ref().and_then(|dead| about.verdict(dead))),
        Answer::Tilt(t) => t
            .directions
            .iter()
            .find_map(|tilt| about.tilt(tilt))
            .or_else(|| t.level.as_ref().and_then(|level| about.verdict(level))),
        Answer::Repose(p) => p
            .directions
            .iter()
            .filter_map(|d| d.rounds.get(d.answer))
            .find_map(|round| about.tilt(&round.tilt)),
        Answer::Thrust(t) => about.verdict(&t.standing).or_else(|| {
            let end = t.ends.iter().find(|e| e.outcome == Outcome::Undecided)?;
            about.search(
                &end.attempts,
                end.findings().fails.first(),
                end.bracket.lower,
                end.bracket.upper,
            )
        }),
        Answer::Critical(c) => about.range(c),
        Answer::Moving(m) => m
            .positions
            .iter()
            .find_map(|s| {
                let dry = |dry| about.dry(dry, "use `--law associative` for the bound alone");
                about.bound(&s.bound).or_else(|| s.dry.as_ref().and_then(dry))
            })
            .or_else(|| m.dead.as_ref().and_then(|dead| about.verdict(dead))),
        Answer::Kinematic(k) => k
            .directions
            .iter()
            .find_map(|d| {
                let dry = |dry| about.dry(dry, "use `--law associative` for the bound alone");
                about.bound(&d.bound).or_else(|| d.dry.as_ref().and_then(dry))
            })
            .or_else(|| k.dead.as_ref().and_then(|dead| about.verdict(dead))),
        Answer::Stages(s) => s.stages.iter().find_map(|s| s.doubt.clone()),
        Answer::Without(w) => {
            let of = |l: &Left| About { model: &l.model, ..about }.verdict(&l.verdict);
            w.each.iter().find_map(of)
        }
        Answer::State(s) => s
            .verdict
            .as_ref()
            .and_then(|v| about.verdict(v))
            .or_else(|| about.bound(s.bound.as_ref()?)),
        // A path says itself where it ended, and why.
        Answer::Path(_) | Answer::Rock(_) => None,
        Answer::Simulate(outcome) => in_time(outcome),
        Answer::Combinations(c) => {
            let worst = c.worst()?;
            doubt(&worst.answer, &worst.model, control)
        }
        Answer::Meet(m) => {
            m.sides.iter().flatten().find_map(|p| doubt(&p.answer, &p.model, control))
        }
        // Single histories are no verdicts.
        Answer::Shake(_) => None,
    }
}

#[derive(Clone, Copy)]
struct About<'a> {
    model: &'a Model,
    late: bool,
}

impl About<'_> {
    fn verdict(&self, a: &Proved<Assessment>) -> Option<Doubt> {
        if a.verdict != Verdict::Undecided {
            return None;
        }
        let b = a.equilibrium_error;
        // What dry friction leaves open is said first.
        if !self.late
            && a.state.is_none()
            && let Some(edges) =
                self.edges("with a small flat there it falls, with another normal it may stand")
        {
            return Some(edges);
        }
        let state = a.state.as_ref().filter(|s| s.motion == StateMotion::Undecided);
        match (self.late, state) {
            (false, Some(state)) if a.findings().fails.is_empty() => {
                let left = state.steps.last().map_or(String::new(), |s| {
                    format!(
                        ": an equilibrium error of {:.1e} g remains at a compliance of {:.0e}",
                        s.acceleration, s.epsilon
                    )
                });
                return Doubt::new(
                    DoubtCause::DryFriction,
                    format!(
                        "balanced forces exist, but with dry friction the blocks neither come to rest nor start a motion{left}"
                    ),
                    "run `voussoir simulate`, which follows the blocks in time",
                );
            }
            (false, None) if b.upper <= tolerance::ON_THE_LINE && a.findings().fails.is_empty() => {
                return Doubt::new(
                    DoubtCause::OnTheLine,
                    format!(
                        "the least equilibrium error lies between {:.0e} and {:.0e} of the weight, too close to zero to decide",
                        b.lower, b.upper
                    ),
                    "change what is uncertain (friction, thickness) by 1 % to either side and compute both",
                );
            }
            _ => {}
        }
        self.search(&a.attempts, a.findings().fails.first(), b.lower, b.upper)
    }

    fn bound(&self, l: &Proved<LoadFactor>) -> Option<Doubt> {
        if l.outcome != Outcome::Undecided {
            return None;
        }
        self.search(&l.attempts, l.findings().fails.first(), l.bracket.lower, l.bracket.upper)
    }

    fn tilt(&self, tilt: &Tilt) -> Option<Doubt> {
        self.bound(&tilt.load_factor).or_else(|| {
            let dry = tilt.dry.as_ref()?;
            self.dry(
                &dry.load_factor,
                "simulate the scene with gravity rotated by the tilt in question",
            )
        })
    }

    /// A value with dry friction that did not come out, or was not seen to be reached.
    fn dry(&self, dry: &Proved<DryLoadFactor>, next: &str) -> Option<Doubt> {
        let claims = matches!(dry.found, Found::NothingSlides | Found::FixedPoint);
        if !(dry.found == Found::Undecided || claims && !dry.is_reached()) {
            return None;
        }
        if self.late {
            return Self::time(dry.solves);
        }
        if let Some(why) = dry.findings().fails.first() {
            return Self::refused(why);
        }
        let rests = dry.rests_at.filter(|&r| r > 0.0);
        let rests =
            rests.map(|r| format!("; at rest up to {}", rounded_down(r))).unwrap_or_default();
        let programs = count(dry.solves, "program");
        Doubt::new(
            DoubtCause::DryFriction,
            format!("the friction limits had not converged after {programs}{rests}"),
            next,
        )
    }

    fn time(attempts: usize) -> Option<Doubt> {
        Doubt::new(
            DoubtCause::TimeLimit,
            format!("time limit reached after {}", count(attempts, "attempt")),
            "raise --time-limit",
        )
    }

    fn refused(why: &str) -> Option<Doubt> {
        Doubt::new(
            DoubtCause::Refused,
            format!("the result failed its own check: {why}"),
            "run again with --keep-all",
        )
    }

    /// Edges or corners that meet with several normals; what is known all the same.
    fn edges(&self, known: &str) -> Option<Doubt> {
        let Model { assembly, interfaces, .. } = self.model;
        let mut flats = interfaces.list.iter().filter(|f| !f.ways.is_empty());
        let first = flats.next()?;
        let [a, b] = [first.a, first.b].map(|i| &assembly.blocks[i].id);
        let more = match flats.count() {
            0 => String::new(),
            n => format!(", as {n} more do"),
        };
        Doubt::new(
            DoubtCause::Edges,
            format!(
                "an edge or corner of {a} meets one of {b}{more}, and the answer depends on which of several normals acts there: {known}"
            ),
            "draw the flat that a real edge has (1 mm), or give the normal: \"interfaces\": [{ \"between\": …, \"normal\": … }]",
        )
    }

    /// A bracket that did not close.
    fn search(
        &self,
        attempts: &[Attempt],
        refused: Option<&String>,
        lower: f64,
        upper: f64,
    ) -> Option<Doubt> {
        if self.late {
            return Self::time(attempts.len());
        }
        let ends = || match lower.is_finite() || upper.is_finite() {
            true => format!(
                "with a small flat there λ is {}, with any normal at most {}",
                short(lower),
                short(upper)
            ),
            false => "neither is known".to_string(),
        };
        if let Some(edges) = self.edges(&ends()) {
            return Some(edges);
        }
        if let Some(why) = refused {
            return Self::refused(why);
        }
        if let Some(spread) = spread(self.model) {
            return Doubt::new(
                DoubtCause::WideNumbers,
                spread,
                "leave out blocks that are much smaller or lighter than the rest, or give a realistic friction",
            );
        }
        let tried = count(attempts.len(), "attempt");
        let status = attempts.last().map_or_else(String::new, |a| {
            format!(", the last of which ended with {:?}", a.engine_status)
        });
        match lower.is_finite() && upper.is_finite() && upper < f64::MAX {
            true => Doubt::new(
                DoubtCause::OpenBracket,
                format!(
                    "after {tried} it is only known to lie between {} and {}{status}",
                    short(lower),
                    short(upper)
                ),
                "run again with --keep-all; until then use the end on the safe side",
            ),
            false => Doubt::new(
                DoubtCause::NoAttempt,
                format!("none of {tried} gave both ends{status}"),
                "run again with --keep-all",
            ),
        }
    }

    /// A range without a flip whose verdict is not one throughout.
    fn range(&self, c: &Critical) -> Option<Doubt> {
        // A flip counts where both sides are decided.
        if !c.changes.is_empty() {
            let open = |s: &Probe<Proved<Assessment>>| self.verdict(&s.assessment);
            let doubts: Vec<Doubt> = c
                .changes
                .iter()
                .filter_map(|f| open(&f.below).or_else(|| open(&f.above)))
                .collect();
            return doubts.into_iter().next().filter(|_| {
                c.changes.iter().all(|f| open(&f.below).or_else(|| open(&f.above)).is_some())
            });
        }
        let is_open = |s: &&Scanned| matches!(s.outcome, Ok((Verdict::Undecided, _)));
        let undecided = c.scan.iter().filter(is_open).count();
        // One value alone that makes no scene is left out.
        let is_none = |k: &usize| c.scan.get(*k).is_none_or(|s| s.outcome.is_err());
        let beside = |k: &usize| *k == 0 || is_none(&(k - 1)) || is_none(&(k + 1));
        let none = (0..c.scan.len()).filter(|k| is_none(k) && beside(k)).count();
        let ends = c.ends.iter().find_map(|p| self.verdict(&p.assessment));
        if undecided + none == 0 && ends.is_none() {
            let [from, to] = c.by_turns.first()?;
            return Doubt::new(
                DoubtCause::Range,
                format!("between {from} and {to} it alternately stands and needs a self-stress"),
                "treat it as needing a self-stress there",
            );
        }
        if self.late {
            return Self::time(c.probes);
        }
        Doubt::new(
            DoubtCause::Range,
            format!(
                "of {} {undecided} are undecided and {none} give no valid scene",
                count(c.scan.len(), "value")
            ),
            "narrow --between to values that give valid scenes",
        )
    }
}

/// How wide the numbers of a scene are spread, where that is wider than solvers carry.
fn spread(model: &Model) -> Option<String> {
    let wide = |what: &str, values: &mut dyn Iterator<Item = f64>| {
        let (low, high) = values
            .filter(|v| *v > 0.0)
            .fold((f64::INFINITY, 0.0_f64), |(l, h), v| (l.min(v), h.max(v)));
        (high > tolerance::WIDE_NUMBERS * low)
            .then(|| format!("{what} range from {} to {}", short(low), short(high)))
    };
    let assembly = &model.assembly;
    let steepest = model
        .interfaces
        .list
        .iter()
        .filter_map(|f| match f.law.friction {
            Friction::Coefficient(mu) => Some(mu),
            Friction::Infinite => None,
        })
        .fold(0.0, f64::max);
    wide(
        "the blocks' loads in N",
        &mut assembly.free().map(|i| certificate::load_scale(assembly, i)),
    )
    .or_else(|| {
        wide("the blocks' sizes in m", &mut assembly.free().map(|i| assembly.blocks[i].size))
    })
    .or_else(|| {
        (steepest > tolerance::STEEPEST_FRICTION)
            .then(|| format!("a coefficient of friction is {}", short(steepest)))
    })
}

fn in_time(outcome: &SimulationOutcome) -> Option<Doubt> {
    if outcome.fate != Fate::Undecided {
        return None;
    }
    let run = outcome.runs.last()?;
    let moved = format!(
        "{} moved by {} of its thickness in {} s",
        run.farthest,
        short(run.relative),
        short(run.time)
    );
    match run.stop {
        Stop::Stopped => Doubt::new(
            DoubtCause::TimeLimit,
            format!(
                "time limit reached after {} of {} s; {moved}",
                short(run.time),
                short(run.horizon)
            ),
            "raise --time-limit",
        ),
        Stop::Broken => Doubt::new(
            DoubtCause::BrokeOff,
            format!(
                "the numbers of the simulation were no longer finite after {} s",
                short(run.time)
            ),
            "run `voussoir assess`, which needs no time steps",
        ),
        Stop::Rest => Doubt::new(
            DoubtCause::StillMoving,
            format!("it came to rest, but only after {moved}"),
            "look at what slipped (--svg), and run `voussoir assess`",
        ),
        Stop::Fallen | Stop::Horizon => Doubt::new(
            DoubtCause::StillMoving,
            format!("it neither rests nor has it fallen: {moved}"),
            format!("simulate longer: --seconds {}", short(2.0 * run.horizon)),
        ),
    }
}
