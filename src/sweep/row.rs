//! The file of rows (`"format": "voussoir-rows/1"`): a header, then one row a line.

use super::{Parameter, Plan, Shard, Sweep};
use analysis::{
    Answer, Assessment, Critical, LoadFactor, Outcome, Proved, Rocking, Stages, Tilt,
    coulomb::{DryLoadFactor, Found},
    critical::{Method, Scanned},
    follow::{
        End,
        answer::{Followed, PointProof},
    },
    state::Stated,
    thrust::ThrustEnd,
};
use check::{
    elastic::PathEnd,
    proof::{
        ResultFile,
        answer::Quantity,
        critical::{CriticalValue, placed},
    },
    rocking,
    verdict::{Rate, Verdict},
};
use dynamics::{Fate, ShakenFate};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use serde_with::skip_serializing_none;

/// The version of the format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum RowsFormat {
    /// Version 1.
    #[default]
    #[serde(rename = "voussoir-rows/1")]
    V1,
}

/// The first line: everything the rows depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Header {
    /// The format and its version.
    pub format: RowsFormat,
    /// Version of the program.
    pub voussoir: String,
    /// Rows of all shards.
    pub rows: usize,
    /// Which of them are here.
    pub shard: Shard,
    /// Whether every row carries a check sum; older files have none.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub sums: bool,
    /// The plan.
    pub plan: Plan,
    /// The scene it names.
    pub scene: Value,
}

impl Header {
    pub(super) fn new(sweep: &Sweep, shard: Shard) -> Self {
        Self {
            format: RowsFormat::V1,
            voussoir: env!("CARGO_PKG_VERSION").into(),
            rows: sweep.rows(),
            shard,
            sums: true,
            plan: sweep.plan.clone(),
            scene: sweep.scene.clone(),
        }
    }

    /// Where the `k`-th parameter of a row stands along its axis ([`Vary::coordinate`]).
    ///
    /// [`Vary::coordinate`]: super::Vary::coordinate
    pub fn coordinate(&self, row: &Row, k: usize) -> f64 {
        let found = self.plan.vary.get(k).zip(row.parameters.get(k));
        found.map_or(f64::NAN, |(vary, value)| vary.coordinate(value))
    }

    /// Why rows under this header are not rows under `other`; the path of the scene file, the names
    /// and whether there are check sums do not matter.
    pub fn differs(&self, other: &Self) -> Option<&'static str> {
        let (a, b) = (&self.plan, &other.plan);
        let vary = |p: &Plan| -> Vec<super::Vary> {
            p.vary.iter().map(|v| super::Vary { name: None, ..v.clone() }).collect()
        };
        [
            (self.voussoir != other.voussoir, "they were made by another version of this program"),
            (a.question != b.question, "the question differs"),
            (vary(a) != vary(b), "what varies differs"),
            (a.sampling != b.sampling, "the sampling differs"),
            (a.seed != b.seed, "the seed differs"),
            (a.records != b.records, "the records differ"),
            (self.scene != other.scene, "the scene differs"),
        ]
        .into_iter()
        .find_map(|(differs, why)| differs.then_some(why))
    }
}

/// How a row ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RowStatus {
    /// It stands.
    Stable,
    /// It stands only with self-stress.
    Conditional,
    /// It falls.
    Unstable,
    /// There is a value.
    Found,
    /// There is no limit.
    Unbounded,
    /// No load factor lets it stand.
    Impossible,
    /// Neither proof closes.
    Undecided,
    /// The scene has no answer; the row says why.
    Error,
}

impl RowStatus {
    /// As written in files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Conditional => "conditional",
            Self::Unstable => "unstable",
            Self::Found => "found",
            Self::Unbounded => "unbounded",
            Self::Impossible => "impossible",
            Self::Undecided => "undecided",
            Self::Error => "error",
        }
    }
}

impl From<Outcome> for RowStatus {
    fn from(outcome: Outcome) -> Self {
        match outcome {
            Outcome::Found => Self::Found,
            Outcome::Unbounded => Self::Unbounded,
            Outcome::Impossible => Self::Impossible,
            Outcome::Undecided => Self::Undecided,
        }
    }
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// An answer.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RowAnswer {
    /// What became of the question.
    pub status: RowStatus,
    /// The load factor, or the tilt in degrees: with dry friction unless the plan says
    /// `associative`.
    pub value: Option<f64>,
    /// Lower end of its bracket; of `assess` that of the least equilibrium error, in multiples of gravity.
    pub lower: Option<f64>,
    /// Upper end. With dry friction that slides it is the bound by associative sliding.
    pub upper: Option<f64>,
    /// How the value with dry friction was found.
    pub dry: Option<Found>,
    /// The direction of the least tilt.
    pub toward: Option<[f64; 3]>,
    /// Where the train of the least load factor is, m.
    pub x: Option<f64>,
    /// Under an earthquake: a0, m/s².
    pub a0: Option<f64>,
    /// The equivalent displacement at which the curve vanishes, m, where it was followed.
    pub d0: Option<f64>,
    /// ζ_E, the share of the earthquake of the site.
    pub site: Option<f64>,
}

impl RowAnswer {
    /// What a row shows of an answer.
    pub fn of_answer(answer: &Answer) -> Self {
        let degrees = |lambda: f64| lambda.atan().to_degrees();
        let verdict = |dead: &Option<Proved<Assessment>>| dead.as_ref().map(|d| d.verdict);
        let tilt = |t: &Tilt, level| Self {
            toward: Some(t.toward.into()),
            ..Self::of_load_factor(
                &t.load_factor,
                t.dry.as_ref().map(|d| &d.load_factor),
                level,
                degrees,
            )
        };
        let least = |all: &mut dyn Iterator<Item = Self>| {
            all.min_by(|a, b| a.governing().total_cmp(&b.governing()))
                .unwrap_or(Self::of(RowStatus::Undecided))
        };
        match answer {
            Answer::Assess(a) => Self::of_assessment(a),
            Answer::Limit(l) => {
                Self::of_load_factor(&l.bound, l.dry.as_ref(), verdict(&l.dead), |lambda| lambda)
            }
            Answer::Moving(m) => {
                least(&mut m.positions.iter().filter(|s| !s.is_at_least()).map(|s| Self {
                    x: Some(s.position.x),
                    ..Self::of_load_factor(&s.bound, s.dry.as_ref(), verdict(&m.dead), |lambda| {
                        lambda
                    })
                }))
            }
            Answer::Tilt(t) => {
                let level = verdict(&t.level);
                least(&mut t.directions.iter().map(|t| tilt(t, level)))
            }
            Answer::Repose(p) => least(
                &mut p
                    .directions
                    .iter()
                    .filter_map(|d| d.rounds.get(d.answer))
                    .map(|r| tilt(&r.tilt, None)),
            ),
            Answer::Critical(c) => Self::of_flips(c),
            Answer::Thrust(t) => {
                t.ends.first().map_or_else(|| Self::of_assessment(&t.standing), Self::of_thrust)
            }
            Answer::Path(p) => Self::of_path(p),
            Answer::Kinematic(k) => least(&mut k.directions.iter().map(|d| Self {
                toward: Some(d.quake.toward.into()),
                ..Self::of_load_factor(&d.bound, d.dry.as_ref(), verdict(&k.dead), |lambda| lambda)
            })),
            Answer::Stages(s) => Self::of_stages(s),
            Answer::Without(w) => match w.count() {
                Some(n) => Self { value: Some(n as f64), ..Self::of(RowStatus::Found) },
                None => Self::of(RowStatus::Undecided),
            },
            Answer::Combinations(c) => match c.worst() {
                Some(worst) => Self::of_answer(&worst.answer),
                None => Self::of(RowStatus::Undecided),
            },
            Answer::Meet(m) => match m.first() {
                Some(p) => Self { value: Some(p.value), ..Self::of(RowStatus::Found) },
                None => Self::of(RowStatus::Undecided),
            },
            Answer::State(s) => Self::of_state(s),
            Answer::Rock(r) => Self::of_rocking(r),
            Answer::Simulate(outcome) => Self::of(match outcome.fate {
                Fate::Stands => RowStatus::Stable,
                Fate::Falls => RowStatus::Unstable,
                Fate::Undecided => RowStatus::Undecided,
            }),
            Answer::Shake(s) => Self::of(match s.shaken.fate {
                ShakenFate::Rests => RowStatus::Stable,
                ShakenFate::Overturned { .. } => RowStatus::Unstable,
                ShakenFate::Moves => RowStatus::Undecided,
            }),
        }
    }

    /// The same with what follows for the site where an earthquake was asked.
    pub fn with_site(self, file: Option<&ResultFile>) -> Self {
        let Some(file) = file else { return self };
        let Some(a) = file.answer.kinematic() else { return self };
        let d0 = a.numbers.capacity.map(|c| c.d0);
        let site = file.required.filter(|r| r.quantity == Quantity::Site).and_then(|r| r.obtained);
        Self { a0: a.numbers.a0, d0, site, ..self }
    }

    /// The load factor of the path; without a live load the greatest displacement.
    fn of_state(s: &Stated) -> Self {
        let Some(track) = &s.track else {
            return Self::of(match s.standing() {
                Verdict::Unstable => RowStatus::Unstable,
                Verdict::Conditional => RowStatus::Conditional,
                Verdict::Stable | Verdict::Undecided => RowStatus::Undecided,
            });
        };
        let Some(bound) = &s.bound else {
            let size = |q: &Rate| q.velocity.norm();
            let most = track.steps[0].displaced.iter().map(size).fold(0.0, f64::max);
            return Self { value: Some(most), ..Self::of(RowStatus::Found) };
        };
        let upper = finite(bound.bracket.upper);
        let factor = s.factor();
        let value = factor.and_then(|f| f.value);
        let status = match (s.end, value) {
            (PathEnd::Unbounded, _) => RowStatus::Unbounded,
            (_, Some(_)) => RowStatus::Found,
            (_, None) => RowStatus::Undecided,
        };
        Self { value, lower: factor.map(|f| f.reached), upper, ..Self::of(status) }
    }

    /// How many stages stand, from the first on, with the verdict of the worst.
    fn of_stages(s: &Stages) -> Self {
        if let Some(order) = &s.order {
            let (held, least) = (order.most_held(), order.least_held);
            let value = held.filter(|h| *h == least).map(|h| h as f64);
            let status = value.map_or(RowStatus::Undecided, |_| RowStatus::Found);
            return Self { value, ..Self::of(status) };
        }
        let verdicts = || s.stages.iter().map(|s| s.verdict.verdict);
        let first = verdicts().take_while(|v| *v == Verdict::Stable).count();
        let status = match verdicts().nth(first) {
            Some(Verdict::Undecided) => RowStatus::Undecided,
            _ => RowStatus::Found,
        };
        Self { value: (status == RowStatus::Found).then_some(first as f64), ..Self::of(status) }
    }

    /// How far it goes: between where it is proved to stand and where to fall. Without an end there
    /// is no limit; a path that was not followed to its end is undecided, with how far it is known.
    fn of_path(p: &Followed) -> Self {
        let proved = |p: &PointProof| p.claim.is_some();
        let values = p.path.points.iter().map(|p| p.value);
        let known = values.zip(&p.proofs).take_while(|(_, proof)| proved(proof)).last();
        let (whole, last) = (p.proofs.iter().all(proved), known.map(|k| k.0));
        match &p.path.end {
            End::Falls(ends) if p.ends.len() == 2 && p.ends.iter().all(proved) => Self {
                value: Some(ends[0].value),
                lower: Some(ends[0].value),
                upper: Some(ends[1].value),
                ..Self::of(RowStatus::Found)
            },
            End::Vanishes if whole => {
                Self { value: last, lower: last, upper: last, ..Self::of(RowStatus::Found) }
            }
            End::Reached if whole => Self { lower: last, ..Self::of(RowStatus::Unbounded) },
            _ => Self { lower: last, ..Self::of(RowStatus::Undecided) },
        }
    }

    /// Whether it overturns; where scales were scanned the least at which it does, between the last
    /// one at which it stands and itself. Without any there is no limit.
    fn of_rocking(r: &Rocking) -> Self {
        if let Some(scan) = &r.scan {
            let first = scan.seen.first();
            return match (first, scan.flips.first()) {
                (Some(&(from, Some(_))), _) => {
                    Self { value: Some(from), upper: Some(from), ..Self::of(RowStatus::Found) }
                }
                (_, Some(flip)) => Self {
                    value: Some(flip.overturns_at()),
                    lower: Some(flip.stands_at()),
                    upper: Some(flip.overturns_at()),
                    ..Self::of(RowStatus::Found)
                },
                _ => Self::of(RowStatus::Unbounded),
            };
        }
        // At the end of a time that was given it may still go either way.
        Self::of(match r.history.fate {
            rocking::Fate::Overturns { .. } => RowStatus::Unstable,
            rocking::Fate::Rests => RowStatus::Stable,
            rocking::Fate::Rocks if r.history.returns => RowStatus::Stable,
            rocking::Fate::Rocks => RowStatus::Undecided,
        })
    }

    fn of_assessment(a: &Assessment) -> Self {
        let status = match a.verdict {
            Verdict::Stable => RowStatus::Stable,
            Verdict::Conditional => RowStatus::Conditional,
            Verdict::Unstable => RowStatus::Unstable,
            Verdict::Undecided => RowStatus::Undecided,
        };
        Self {
            lower: finite(a.equilibrium_error.lower),
            upper: finite(a.equilibrium_error.upper),
            ..Self::of(status)
        }
    }

    /// The bound and, where it was asked for, the load factor with dry friction; values are read
    /// through `scale`; `dead` is the verdict without the live load, where that was asked.
    fn of_load_factor(
        bound: &LoadFactor,
        dry: Option<&Proved<DryLoadFactor>>,
        dead: Option<Verdict>,
        scale: fn(f64) -> f64,
    ) -> Self {
        let answer = Self {
            value: bound.found().map(scale),
            lower: finite(bound.bracket.lower).map(scale),
            upper: finite(bound.bracket.upper).map(scale),
            ..Self::of(bound.outcome.into())
        };
        let Some(dry) = dry else { return answer };
        // A value is one only up to which the state was seen at rest.
        let claims = matches!(dry.found, Found::NothingSlides | Found::FixedPoint);
        let found = if claims && !dry.is_reached() { Found::Undecided } else { dry.found };
        let value = dry.value.map(scale);
        match found {
            // The bound itself is the answer, with its bracket.
            Found::NothingSlides | Found::Unlimited => Self { dry: Some(found), ..answer },
            Found::FixedPoint => {
                Self { status: RowStatus::Found, value, lower: None, dry: Some(found), ..answer }
            }
            Found::Rests | Found::RestsBelow => Self {
                status: RowStatus::Found,
                value,
                lower: dry.rests_at.map(scale),
                dry: Some(found),
                ..answer
            },
            Found::NotAtRest if bound.bracket.upper < 0.0 || dead == Some(Verdict::Unstable) => {
                Self { dry: Some(found), ..Self::of(RowStatus::Unstable) }
            }
            Found::NotAtRest => Self { dry: Some(found), ..Self::of(RowStatus::Conditional) },
            Found::AtLeast | Found::Undecided => Self {
                status: RowStatus::Undecided,
                value: None,
                lower: dry.rests_at.filter(|_| found == Found::AtLeast).map(scale),
                dry: Some(found),
                ..answer
            },
        }
    }

    /// The first flip of the range, where its value is proved as a result has it; without any flip
    /// the verdict throughout, where all values that were asked have it.
    fn of_flips(c: &Critical) -> Self {
        let first = c.changes.first().and_then(|f| {
            let ends = [f.below.value, f.above.value];
            let known = placed(f.value, f.method, ends).1 != Method::Scan || c.whole;
            let verdicts = [&f.below, &f.above].map(|probe| probe.assessment.verdict);
            CriticalValue::new((f.value, f.method), ends, verdicts).filter(|_| known)
        });
        if let Some(flip) = first {
            return Self {
                value: Some(flip.value),
                lower: Some(flip.lower),
                upper: Some(flip.upper),
                ..Self::of(RowStatus::Found)
            };
        }
        let verdict = |s: &Scanned| s.outcome.as_ref().ok().map(|o| o.0);
        match &c.ends[..] {
            [first, second] if c.changes.is_empty() => {
                let same = |v: Verdict| v == first.assessment.verdict;
                let all = c.scan.iter().all(|s| verdict(s).is_some_and(same));
                match all && same(second.assessment.verdict) {
                    true => Self::of_assessment(&first.assessment),
                    false => Self::of(RowStatus::Undecided),
                }
            }
            _ => Self::of(RowStatus::Undecided),
        }
    }

    fn of_thrust(end: &Proved<ThrustEnd>) -> Self {
        match end.outcome {
            Outcome::Found => Self {
                value: end.value,
                lower: finite(end.bracket.lower),
                upper: finite(end.bracket.upper),
                ..Self::of(RowStatus::Found)
            },
            other => Self::of(other.into()),
        }
    }

    /// Which direction governs: one without an answer must not hide behind the others.
    fn governing(&self) -> f64 {
        match self.status {
            RowStatus::Unbounded => f64::INFINITY,
            _ => self.value.unwrap_or(f64::NEG_INFINITY),
        }
    }

    /// An answer that is only a word.
    pub fn of(status: RowStatus) -> Self {
        let (value, lower, upper) = (None, None, None);
        let (dry, toward, x, a0, d0, site) = (None, None, None, None, None, None);
        Self { status, value, lower, upper, dry, toward, x, a0, d0, site }
    }
}

/// One row. The time stands last: everything before it is the same whatever the threads.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Its number, from 0.
    pub row: usize,
    /// The numbers and words, in the order of the plan's `vary`.
    pub parameters: Vec<Parameter>,
    /// The answer.
    #[serde(flatten)]
    pub answer: RowAnswer,
    /// Why there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// Seconds it took.
    pub seconds: f64,
}

impl Row {
    /// Whether two rows say the same, the time apart.
    pub fn same(&self, other: &Self) -> bool {
        Self { seconds: other.seconds, ..self.clone() } == *other
    }
}
