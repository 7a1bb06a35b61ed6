//! Newton's method for one program of a fixed point on the state: the rates of the blocks are the
//! unknowns, the forces follow from them ([`Response`]), and each step is one sparse factorisation
//! with as many rows as the blocks have rates. Started from the solution before, which differs by a
//! little friction, it takes two to five steps, where the interior-point engine starts from scratch
//! each time.

use crate::{
    Cholesky, Pattern,
    deadline::Deadline,
    program::{
        coulomb::{Contacts, HeldQuantity},
        response::{Answer, FrictionLimits, Response},
    },
};

/// Most steps. Fewer: scenes of which many contacts open and close go back to the engine, for good
/// in this fixed point. More: the engine, whose twelve to twenty iterations cost two to four steps
/// each in every one of twenty solutions, would have been there before.
const STEPS: usize = 400;

/// A full step is taken that leaves less than this of the imbalance. Larger: steps that lead
/// nowhere. Smaller: many searches along the line.
const FALL: f64 = 0.5;

/// A search along the line ends where the slope is this × the one at its start. Larger: short
/// steps. Smaller: many looks at the forces.
const SLOPE: f64 = 0.1;

/// Most looks along a line.
const LOOKS: usize = 40;

/// The imbalance aimed at, in the loads that pass the blocks, over ε: that of the rates. Larger:
/// the friction limits settle no better. Smaller: one more step for nothing.
const EXACT: f64 = 1e-8;

/// The imbalance, in the same loads, that is good enough where rounding allows no better. Larger:
/// noise in the rates at small ε, and the engine would have done better. Smaller: scenes of large
/// forces, which it does no better either, go back to it.
const ENOUGH: f64 = 1e-10;

/// Rounding of the imbalance for each of the rates, which are large where something moves or ε is
/// small. Larger: noise in the acceleration. Smaller: scenes whose rounding is larger wander about
/// the solution and go back to the engine.
const ROUNDING: f64 = 1e-13;

/// A solver of the programs of one scene.
pub struct Newton {
    response: Response,
    cholesky: Cholesky,
    /// What the imbalance of each row is measured by: a heavy block makes no room for a light one.
    carried: Vec<f64>,
    /// How many matrices it has factored.
    pub factors: usize,
}

/// One solution.
#[derive(Clone)]
pub struct Solved {
    /// Forces per column.
    pub forces: Vec<f64>,
    /// Rates per row.
    pub rates: Vec<f64>,
}

impl Newton {
    /// `None` where the forces do not follow from the rates, or the factor does not fit into
    /// memory.
    pub fn new(contacts: &Contacts) -> Option<Self> {
        let response = Response::new(contacts)?;
        let (starts, rows) = response.pattern();
        let cholesky = Cholesky::new(Pattern { starts: starts.to_vec(), rows: rows.to_vec() })?;
        Some(Self { response, cholesky, carried: contacts.carried(), factors: 0 })
    }

    /// Solves one program from the rates `start`; `None` where it does not get there, or not before
    /// `end`.
    pub fn solve(
        &mut self,
        contacts: &Contacts,
        (epsilon, quantity, held): (f64, HeldQuantity, &[f64]),
        start: &[f64],
        end: Deadline,
    ) -> Option<Solved> {
        if !Response::is_explicit(contacts, quantity) {
            return None;
        }
        let friction = FrictionLimits::Held(quantity, held);
        let look = |q: &[f64]| self.response.forces(contacts, epsilon, friction, q);
        let left = |g: &[f64]| {
            g.iter().zip(&self.carried).map(|(g, c)| (g / c).powi(2)).sum::<f64>().sqrt()
        };
        let mut rates = start.to_vec();
        let (mut forces, mut gradient) = look(&rates);
        for _ in 0..STEPS {
            let size = left(&gradient);
            if size <= EXACT * epsilon {
                return Some(Solved { forces, rates });
            }
            if !size.is_finite() || end.is_over() {
                return None;
            }
            self.factors += 1;
            let Answer { triangles: [lower], .. } =
                self.response.answer(contacts, epsilon, friction, &rates);
            if !self.cholesky.factorize(&lower) {
                return None;
            }
            let mut step: Vec<f64> = gradient.iter().map(|g| -g).collect();
            self.cholesky.solve(&mut step);
            let at = |share: f64| {
                rates.iter().zip(&step).map(|(q, s)| q + share * s).collect::<Vec<f64>>()
            };
            let mut best = at(1.0);
            let (mut f, mut g) = look(&best);
            if left(&g) > FALL * size {
                // No better for rounding.
                if size <= ENOUGH.max(ROUNDING * dot(&rates, &rates).sqrt()) {
                    return Some(Solved { forces, rates });
                }
                let (first, mut last) = (dot(&gradient, &step), dot(&g, &step));
                let (mut low, mut high) = ((0.0, first), (1.0, last));
                for _ in 0..LOOKS {
                    // Downhill all the way, or near enough to the bottom.
                    if high.1 <= 0.0 || last.abs() <= SLOPE * first.abs() {
                        break;
                    }
                    let share =
                        low.0 + (high.0 - low.0) * (low.1 / (low.1 - high.1)).clamp(0.1, 0.9);
                    best = at(share);
                    (f, g) = look(&best);
                    last = dot(&g, &step);
                    if last > 0.0 { high = (share, last) } else { low = (share, last) }
                }
            }
            (rates, forces, gradient) = (best, f, g);
        }
        None
    }
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::{super::Exact, *};
    use crate::{
        self as solve, Settings,
        program::{StaticsOptions, coulomb::Objective},
    };
    use model::interface::prepare;
    use scene::read_str;

    fn norm(a: &[f64]) -> f64 {
        dot(a, a).sqrt()
    }

    /// A leaning stack of three, pushed by its load, on a support; all parts in three dimensions.
    fn contacts(joints: &str, loads: &str) -> Contacts {
        let text = format!(
            r#"{{ "format": "voussoir-scene/1", "joints": {{ "default": {joints} }}, "loads": {{ "dead": [{loads}] }}, "blocks": [
            {{ "id": "base", "support": true, "at": [0, 0, -0.5], "shape": {{ "box": {{ "size": [3, 3, 1] }} }} }},
            {{ "id": "a", "at": [0, 0, 0.5], "shape": {{ "box": {{ "size": [1, 0.8, 1] }} }} }},
            {{ "id": "b", "at": [0.1, 0.05, 1.4], "shape": {{ "box": {{ "size": [1, 0.8, 0.8] }} }} }},
            {{ "id": "c", "at": [0.3, 0.1, 2.3], "density": 9000, "shape": {{ "box": {{ "size": [0.7, 1.1, 1] }} }} }} ] }}"#
        );
        let model = prepare(&read_str("stack", &text).unwrap().0).unwrap();
        Contacts::new(&model, StaticsOptions { symmetry: true, ..StaticsOptions::default() })
    }

    fn scenes() -> Vec<Contacts> {
        let push = r#"{ "block": "c", "force": [4000, 1500, 0] }"#;
        let strength = r#"{ "friction": 0.5, "cohesion": 3000, "tension": 1000 }"#;
        vec![
            contacts(r#"{ "friction": 0.5 }"#, push),
            contacts(r#"{ "friction": 0.5 }"#, r#"{ "block": "c", "force": [4000, 0, 0] }"#),
            contacts(r#"{ "friction": "infinite" }"#, push),
            contacts(r#"{ "friction": 0 }"#, push),
            contacts(strength, push),
        ]
    }

    /// A direction and a point without any symmetry.
    fn numbers(n: usize, seed: f64, size: f64) -> Vec<f64> {
        (0..n).map(|k| size * (seed + 1.7 * k as f64 + 0.1 * (k * k) as f64).sin()).collect()
    }

    #[test]
    fn the_derivative_is_that_of_the_imbalance() {
        for (which, contacts) in scenes().iter().enumerate() {
            let response = Response::new(contacts).unwrap();
            let n = contacts.statics.matrix.rows;
            let (starts, rows) = response.pattern();
            let held: Vec<f64> =
                numbers(contacts.discs().count(), 0.3, 0.4).iter().map(|v| v.abs()).collect();
            let (limits, sliding) = (
                FrictionLimits::Held(HeldQuantity::Limits, &held),
                FrictionLimits::Held(HeldQuantity::SlidingRates, &held),
            );
            let memory = numbers(contacts.compliance.len(), 0.7, 2.0);
            let since = FrictionLimits::Since(&memory);
            for (friction, size) in [limits, sliding, FrictionLimits::Law, since]
                .into_iter()
                .flat_map(|f| [(f, 0.5), (f, 3.0)])
            {
                let (q, step) = (numbers(n, 1.0, size), numbers(n, 2.0, 1e-7));
                let imbalance = |sign: f64| {
                    let q: Vec<f64> = q.iter().zip(&step).map(|(q, s)| q + sign * s).collect();
                    response.forces(contacts, 1e-3, friction, &q).1
                };
                let Answer { triangles: [lower, upper], .. } =
                    response.answer(contacts, 1e-3, friction, &q);
                let mut predicted = vec![0.0; n];
                for column in 0..n {
                    for at in starts[column]..starts[column + 1] {
                        predicted[rows[at]] += lower[at] * step[column];
                        if rows[at] != column {
                            predicted[column] += upper[at] * step[rows[at]];
                        }
                    }
                }
                let seen: Vec<f64> = imbalance(1.0)
                    .iter()
                    .zip(imbalance(-1.0))
                    .map(|(a, b)| 0.5 * (a - b))
                    .collect();
                let apart: Vec<f64> = seen.iter().zip(&predicted).map(|(a, b)| a - b).collect();
                assert!(
                    norm(&apart) < 1e-5 * norm(&seen),
                    "scene {which} {friction:?} {size}: {} of {}",
                    norm(&apart),
                    norm(&seen)
                );
            }
        }
    }

    #[test]
    fn newton_and_the_interior_point_engine_find_the_same_forces() {
        for (which, contacts) in scenes().iter().enumerate() {
            let mut newton = Newton::new(contacts).unwrap();
            let start = vec![0.0; contacts.statics.matrix.rows];
            for (quantity, epsilon) in [
                (HeldQuantity::Limits, 1e-3),
                (HeldQuantity::Limits, 1e-6),
                (HeldQuantity::SlidingRates, 1e-3),
            ] {
                let held: Vec<f64> =
                    numbers(contacts.discs().count(), 0.3, 0.4).iter().map(|v| v.abs()).collect();
                let found = newton
                    .solve(contacts, (epsilon, quantity, &held), &start, Deadline::NEVER)
                    .unwrap();
                let settings = Settings { tolerance: 1e-12, ..Settings::default() };
                let engine = solve::solve(
                    &contacts.program(Objective::State(epsilon), quantity, &held),
                    &settings,
                );
                let size = norm(&found.forces);
                for (a, b) in found.forces.iter().zip(&engine.x) {
                    assert!(
                        (a - b).abs() < 1e-5 * size,
                        "scene {which} {quantity:?} {epsilon}: {a} and {b} of {size}"
                    );
                }
            }
        }
    }

    #[test]
    fn without_further_rates_contacts_keep_their_forces() {
        for (which, contacts) in scenes().iter().enumerate() {
            let response = Response::new(contacts).unwrap();
            let mut memory = vec![0.0; contacts.compliance.len()];
            let n = contacts.statics.matrix.rows;
            for seed in [1.0, 2.0, 3.0] {
                let q = numbers(n, seed, 2.0);
                let (forces, _) =
                    response.forces(contacts, 1e-3, FrictionLimits::Since(&memory), &q);
                memory = response.memory(contacts, &memory, &q, &forces);
                let (same, _) =
                    response.forces(contacts, 1e-3, FrictionLimits::Since(&memory), &vec![0.0; n]);
                for (a, b) in forces.iter().zip(&same) {
                    assert!((a - b).abs() < 1e-12 * norm(&forces), "scene {which}: {a} and {b}");
                }
                assert!(norm(&forces) > 0.0);
            }
        }
    }

    /// Where nothing slides it is the same whether it came about in time or at once; the drag that is
    /// left of one step is gone then.
    #[test]
    fn what_comes_about_in_time_ends_where_newton_does() {
        let epsilon = 1e-6;
        let never = |_: f64, _: &(Solved, f64)| false;
        for (which, contacts) in scenes().iter().enumerate() {
            let mut law = Exact::new(contacts).unwrap();
            let still = vec![0.0; contacts.statics.matrix.rows];
            let (_, (flowed, left)) =
                law.flowed(contacts, (epsilon, 0.0), never, usize::MAX, Deadline::NEVER).unwrap();
            assert!(left < 1e-4 * epsilon, "scene {which}: {left}");
            let (near, _) = law.near(contacts, epsilon, &still, Deadline::NEVER).unwrap();
            for (a, b) in flowed.forces.iter().zip(&near.forces) {
                assert!((a - b).abs() < 1e-4 * norm(&near.forces), "scene {which}: {a} and {b}");
            }
            let smaller = (0.1 * epsilon, 0.0);
            let none = law.flowed(contacts, smaller, never, usize::MAX, Deadline::within(0.0));
            assert!(none.is_none());
        }
    }

    /// A block pushed by nine tenths of its weight at μ = 0.5 goes on with four tenths of it (its load,
    /// which is the unit, is both); whoever looks may end it.
    #[test]
    fn what_slides_goes_on_as_it_does() {
        let text = r#"{ "format": "voussoir-scene/1", "joints": { "default": { "friction": 0.5 } },
            "loads": { "dead": [{ "weight": [0.9, 0, 0] }] }, "blocks": [
            { "id": "base", "support": true, "at": [0, 0, -0.5], "shape": { "box": { "size": [9, 9, 1] } } },
            { "id": "a", "at": [0, 0, 0.25], "shape": { "box": { "size": [2, 2, 0.5] } } } ] }"#;
        let model = prepare(&read_str("sliding", text).unwrap().0).unwrap();
        let mut contacts = Contacts::new(&model, StaticsOptions::default());
        contacts.by_mass();
        let mut law = Exact::new(&contacts).unwrap();
        let far = |rates: &[f64]| rates.iter().fold(0.0, |most: f64, q| most.max(q.abs()));
        let mut looks = Vec::new();
        let look = |epsilon: f64, seen: &(Solved, f64)| {
            looks.push((1.0 / epsilon, far(&seen.0.rates)));
            looks.len() == 4
        };
        let (reached, _) =
            law.flowed(&contacts, (1e-6, 1e-3), look, usize::MAX, Deadline::NEVER).unwrap();
        assert_eq!((looks.len(), 1.0 / reached), (4, looks[3].0));
        assert!(looks[0].0 >= 1e3 && looks[3].0 < 1e6);
        for pair in looks.windows(2) {
            let speed = (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0);
            assert!((speed * 1.81_f64.sqrt() - 0.4).abs() < 1e-6, "{speed}");
        }
    }

    #[test]
    fn out_of_time_there_is_no_solution() {
        let contacts = contacts(r#"{ "friction": 0.5 }"#, "");
        let start = vec![0.0; contacts.statics.matrix.rows];
        let held = vec![0.1; contacts.discs().count()];
        let solved = Newton::new(&contacts).unwrap().solve(
            &contacts,
            (1e-3, HeldQuantity::Limits, &held),
            &start,
            Deadline::within(0.0),
        );
        assert!(solved.is_none());
    }
}
