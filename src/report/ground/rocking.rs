//! What a mechanism does on ground that moves.

use super::{
    GroundError, Shaking,
    chart::{Panel, chart},
    refused,
};
use crate::{
    cells::{Cell, Table},
    text::{Layout, Page, Role, TextOptions},
};
use analysis::follow::machine::{Built, Exactness};
use base::number::{bracketed, count, fixed, point, short};
use check::{
    ground::Motion,
    rocking::{Fate, History, Sample, Scan, Sense},
};
use serde_json::{Value, json};

/// So many impacts are listed.
const FEW: usize = 8;

/// A history with all that it is about.
pub struct Rocked<'a> {
    /// The scene's name.
    pub name: &'a str,
    /// Names of the scene's blocks.
    pub ids: &'a [String],
    /// The machine.
    pub built: &'a Built,
    /// The ground.
    pub shaking: &'a Shaking,
    /// Where it began, as a part of the unstable equilibrium.
    pub from: f64,
    /// Whether the restitution was given.
    pub given_restitution: bool,
    /// What it did.
    pub history: &'a History,
    /// At which scales it overturns, where that was asked.
    pub scan: Option<&'a Scan>,
}

impl Rocked<'_> {
    fn sense(&self, q: f64) -> Option<&Sense> {
        self.built.machine.senses[usize::from(q < 0.0)].as_ref()
    }

    /// Way of the control point, m.
    fn way(&self, s: &Sample) -> f64 {
        let moved = self.sense(s.q).filter(|_| s.q != 0.0);
        moved.map_or(0.0, |sense| sense.law.at(s.q.abs()).way)
    }

    /// The coordinate over the unstable equilibrium.
    fn part(&self, q: f64) -> Option<f64> {
        let unstable = self.sense(q)?.unstable?;
        Some(q / unstable)
    }

    fn title(&self) -> (String, Role) {
        let greatest = &self.history.greatest;
        let far = || {
            let over = short((self.way(greatest) / self.built.thickness).abs());
            match self.part(greatest.q) {
                Some(part) => format!(
                    "{} of the way to its unstable equilibrium ({over} of its thickness)",
                    short(part.abs())
                ),
                None => format!("{over} of its thickness"),
            }
        };
        match self.history.fate {
            Fate::Overturns { time } => {
                (format!("overturns: past return at {} s", fixed(time, 4)), Role::Bad)
            }
            Fate::Rests if self.history.released.is_none() => ("does not move".into(), Role::Good),
            Fate::Rests => (format!("rocks up to {}, comes to rest", far()), Role::Good),
            Fate::Rocks => (format!("still rocks at the end, up to {}", far()), Role::Unsure),
        }
    }

    fn exactness(&self) -> String {
        match &self.built.exactness {
            Exactness::Exact => {
                "computed, not proved: exact for rigid blocks that neither slide nor bounce".into()
            }
            Exactness::Idealised(why) => format!(
                "computed, not proved, and an idealisation: {why}; `voussoir simulate --ground` runs all blocks"
            ),
        }
    }

    /// The answer for people.
    pub fn text(&self, layout: Layout, options: TextOptions) -> Page {
        let mut page = Page::new(layout);
        let (title, role) = self.title();
        page.title(self.name, title, role);
        if options.brief {
            return page;
        }
        page.blank();
        page.paragraph(
            "The mechanism that limit analysis proves, as a machine of one degree of freedom, integrated through the motion of the ground; impacts, releases and turning points are found as roots. It starts to move where the acceleration passes the proved load factor.",
        );
        page.blank();
        page.row("ground", [self.shaking.words()]);
        let factors = self.built.proofs.iter().enumerate().map(|(k, (_, l))| {
            let sense = ["towards", "against"][k];
            let d: [f64; 3] = self.built.toward.into();
            match l.value {
                Some(value) => {
                    let number = bracketed(value, l.bracket.lower, l.bracket.upper);
                    format!("{sense} {}: moves beyond {number} g (proved)", point(d))
                }
                None => format!("{sense} {}: nothing moves (proved)", point(d)),
            }
        });
        page.row("load factor", factors);
        page.row("machine", [self.machine()]);
        page.row("restitution", [self.restitution()]);
        page.row("history", self.history_rows());
        if let Some(scan) = self.scan {
            page.row("scales", scales(scan));
        }
        page.row("computed", [self.exactness()]);
        page.row("note", self.built.notes.iter().cloned());
        if let Some(record) = &self.shaking.record {
            page.row("record", record.findings.iter().map(|f| f.text.clone()));
        }
        page
    }

    fn machine(&self) -> String {
        let (block, at) = self.built.control;
        let id = self.ids.get(block).map_or("", String::as_str);
        let mut text = String::new();
        if let Some(sense) = &self.built.machine.senses[0] {
            if let Some(p) = sense.frequency() {
                text += &format!("p = {} 1/s; ", short(p));
            }
            if let Some(q) = sense.unstable {
                text += &format!(
                    "unstable at {} rad, {} m of the control point; ",
                    short(q),
                    short(sense.law.at(q).way)
                );
            }
        }
        format!(
            "{text}control point {} of {id}, {} m thick",
            point(at.into()),
            short(self.built.thickness)
        )
    }

    fn restitution(&self) -> String {
        let [a, b] = self.built.machine.restitution;
        let [c, d] = self.built.conserving;
        let said = |a: f64, b: f64| {
            if (a - b).abs() <= 1e-9 * a.abs() {
                fixed(a, 6)
            } else {
                format!("{} and {}", fixed(a, 6), fixed(b, 6))
            }
        };
        if self.given_restitution {
            format!("{} of the speed, as given; momentum would leave {}", said(a, b), said(c, d))
        } else {
            format!("{} of the speed, by conservation of momentum (no bounce)", said(a, b))
        }
    }

    fn history_rows(&self) -> Vec<String> {
        let h = self.history;
        let mut rows = Vec::new();
        if self.from != 0.0 {
            rows.push(format!("begins at {} of the unstable equilibrium", short(self.from)));
        }
        if let Some(t) = h.released {
            rows.push(format!("released at {} s", fixed(t, 4)));
        }
        let place = |s: &Sample| {
            let way = self.way(s);
            let part = self.part(s.q).map_or(String::new(), |p| {
                format!(", {} of the unstable equilibrium", short(p.abs()))
            });
            format!(
                "{} m, {} of the thickness{part}",
                short(way),
                short(way / self.built.thickness)
            )
        };
        if h.greatest.q != 0.0 {
            rows.push(format!(
                "greatest at {} s: {}",
                fixed(h.greatest.time, 4),
                place(&h.greatest)
            ));
        }
        if !h.overturned() {
            rows.push(format!("residual at {} s: {}", fixed(h.last.time, 4), place(&h.last)));
        }
        if !h.impacts.is_empty() {
            let first = h.impacts.iter().take(FEW).map(|i| fixed(i.time, 4));
            let times = first.collect::<Vec<_>>().join(", ");
            let more = if h.impacts.len() > FEW { ", …" } else { "" };
            rows.push(format!("{} at {times}{more} s", count(h.impacts.len(), "impact")));
        }
        rows
    }

    /// The answer for programs.
    pub fn json(&self) -> Value {
        let h = self.history;
        let place = |s: &Sample| {
            let way = self.way(s);
            json!({
                "time": s.time, "turn": s.q, "of_unstable": self.part(s.q), "way": way,
                "over_thickness": way / self.built.thickness,
            })
        };
        let sense = |k: usize| {
            let (sense, proof) = (self.built.machine.senses[k].as_ref(), &self.built.proofs[k].1);
            let number = |v: f64| v.is_finite().then_some(v);
            json!({
                "load_factor": proof.value, "lower": number(proof.bracket.lower),
                "upper": number(proof.bracket.upper),
                "frequency": sense.and_then(Sense::frequency),
                "unstable": sense.and_then(|s| s.unstable),
                "restitution": self.built.machine.restitution[k],
                "conserving": self.built.conserving[k],
            })
        };
        let (fate, time) = match h.fate {
            Fate::Overturns { time } => ("overturns", Some(time)),
            Fate::Rests => ("rests", None),
            Fate::Rocks => ("rocks", None),
        };
        let impacts: Vec<Value> = h
            .impacts
            .iter()
            .map(|i| json!({ "time": i.time, "before": i.before, "factor": i.factor }))
            .collect();
        let scan = self.scan.map(|s| {
            s.flips
                .iter()
                .map(|f| json!({ "overturns_at": f.overturns_at(), "stands_at": f.stands_at() }))
                .collect::<Vec<_>>()
        });
        json!({
            "format": "voussoir-rocking/1", "scene": self.name,
            "toward": <[f64; 3]>::from(self.built.toward), "ground": self.shaking.json(),
            "towards": sense(0), "against": sense(1), "thickness": self.built.thickness,
            "control": { "block": self.ids.get(self.built.control.0), "point": <[f64; 3]>::from(self.built.control.1) },
            "proved": ["load_factor"],
            "exact": self.built.exactness == Exactness::Exact,
            "idealised": match &self.built.exactness { Exactness::Idealised(why) => Some(why), Exactness::Exact => None },
            "from": self.from, "fate": fate, "overturned_at": time, "released_at": h.released,
            "greatest": place(&h.greatest), "residual": (!h.overturned()).then(|| place(&h.last)),
            "impacts": impacts, "flips": scan, "notes": self.built.notes,
        })
    }

    /// The history, a row a step: time (s), turn (rad), its rate (1/s), way of the control point (m)
    /// and over its thickness, acceleration of the ground along the direction (m/s²).
    ///
    /// # Errors
    /// Only if memory runs out.
    pub fn csv(&self) -> Result<String, GroundError> {
        let mut table = Table::new();
        table
            .write_record(
                ["time", "turn", "rate", "way", "over_thickness", "ground"].map(Cell::from),
            )
            .map_err(refused)?;
        for s in &self.history.samples {
            let way = self.way(s);
            let ground = self.shaking.motion.at(s.time).x;
            let row = [s.time, s.q, s.rate, way, way / self.built.thickness, ground];
            table.write_record(row.map(Cell::from)).map_err(refused)?;
        }
        table.end().map_err(refused)
    }

    /// Way over thickness against time, and the ground below it, as SVG.
    ///
    /// # Errors
    /// Nothing moves, and no time passes.
    pub fn chart(&self) -> Result<String, GroundError> {
        let own: Vec<(f64, f64)> = self
            .history
            .samples
            .iter()
            .map(|s| (s.time, self.way(s) / self.built.thickness))
            .collect();
        let ground: Vec<(f64, f64)> = ground(&self.shaking.motion, own.last().map_or(0.0, |p| p.0));
        let upper = Panel { y: "displacement / thickness", lines: &[own] };
        let lower = Panel { y: "ground, m/s²", lines: &[ground] };
        chart(self.name, upper, lower)
    }
}

/// The acceleration of the ground along the direction, for a chart up to this time.
pub(super) fn ground(motion: &Motion, end: f64) -> Vec<(f64, f64)> {
    const FINE: usize = 24;
    let mut line = vec![(0.0, 0.0)];
    for p in motion.pieces.iter().filter(|p| p.start < end) {
        let steps = if motion.pieces.len() > 100 { 1 } else { FINE };
        line.extend((0..=steps).map(|k| {
            let t = (p.end - p.start) * k as f64 / steps as f64;
            (p.start + t, p.at(t).x)
        }));
    }
    let last = line.last().map_or(0.0, |p| p.0);
    line.push((last, 0.0));
    line.push((end.max(last), 0.0));
    line
}

fn scales(scan: &Scan) -> Vec<String> {
    let mut rows: Vec<String> = scan
        .flips
        .iter()
        .map(|f| {
            format!(
                "overturns at {}, stands at {}",
                fixed(f.overturns_at(), 6),
                fixed(f.stands_at(), 6)
            )
        })
        .collect();
    let (from, to) =
        (scan.seen.first().map_or(0.0, |s| s.0), scan.seen.last().map_or(0.0, |s| s.0));
    let over = scan.seen.iter().filter(|s| s.1.is_some()).count();
    rows.push(format!(
        "{} between {} and {}: overturns at {over}; more shaking may be safer, and flips closer together than the scan's step may stay unseen",
        count(scan.seen.len(), "scale"),
        short(from),
        short(to)
    ));
    rows
}
