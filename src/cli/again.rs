//! The options that would have to be given again for the same answer, as typed.

use super::args::{
    Assess, Common, Critical, Curve, DIRECTIONS, Ground, Kinematic, Law, Push, Quadrature, Settle,
    Simulate, Stages, State, Thrust, Tilt,
};
use voussoir::sweep::Between;

/// As typed, where it was given.
pub fn skip_dead(given: bool) -> Vec<String> {
    if given { vec!["--skip-dead".into()] } else { Vec::new() }
}

/// As typed, where there are ranges.
pub fn worst(ranges: &[Between]) -> Vec<String> {
    let list: Vec<String> = ranges.iter().map(Between::to_string).collect();
    if list.is_empty() { Vec::new() } else { vec![format!("--worst {}", list.join(","))] }
}

impl Tilt {
    /// The options that change the answer, as typed.
    pub fn options(&self) -> Vec<String> {
        let toward = self.toward.iter().map(|[x, y, z]| {
            if *z == 0.0 { format!("--toward {x},{y}") } else { format!("--toward {x},{y},{z}") }
        });
        let all = (self.all != DIRECTIONS).then(|| format!("--all {}", self.all));
        toward.chain(all).chain(skip_dead(self.skip_dead)).collect()
    }
}

impl Critical {
    /// The options that change the answer, as typed.
    pub fn options(&self) -> Vec<String> {
        let ends: Vec<String> = self.between.iter().map(f64::to_string).collect();
        let range = [
            format!("--vary {}", super::question::quoted(&self.vary)),
            format!("--between {}", ends.join(" ")),
        ];
        let step = self.step.map(|s| format!("--step {s}"));
        let scan = self.scan.map(|n| format!("--scan {n}"));
        range.into_iter().chain(step).chain(scan).collect()
    }
}

impl Thrust {
    /// The options that change the answer, as typed.
    pub fn options(&self) -> Vec<String> {
        let support =
            self.support.as_ref().map(|s| format!("--support {}", super::question::quoted(s)));
        let direction = self.direction.map(|[x, y, z]| format!("--direction {x},{y},{z}"));
        let member = self.member.as_ref();
        let member = member.map(|m| format!("--member {}", super::question::quoted(m)));
        support.into_iter().chain(direction).chain(member).collect()
    }
}

/// Numbers with commas between.
fn list(numbers: &[f64]) -> String {
    numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(",")
}

/// As typed, where there are values.
fn at(values: &[f64]) -> Option<String> {
    (!values.is_empty()).then(|| format!("--at {}", list(values)))
}

impl Curve {
    fn begun(&self) -> Option<String> {
        let from = self.from.as_ref()?.to_string_lossy();
        Some(format!("--from {}", super::question::quoted(&from)))
    }
}

impl Settle {
    /// The options that change the answer, as typed.
    pub fn options(&self) -> Vec<String> {
        let moves = self.moves.iter().map(|m| {
            let turn = if m.turn_deg == [0.0; 3] { &[][..] } else { &m.turn_deg };
            let numbers = [&m.way[..], turn].concat();
            let word = if m.out == 0.0 {
                format!("{}={}", m.support, list(&numbers))
            } else {
                format!("{}=out:{}", m.support, m.out)
            };
            format!("--move {}", super::question::quoted(&word))
        });
        moves.chain(at(&self.at)).chain(self.curve.begun()).collect()
    }
}

impl Push {
    /// The options that change the answer, as typed.
    pub fn options(&self) -> Vec<String> {
        let word = format!("{}={}", self.control.0, list(&self.control.1));
        let control = format!("--control {}", super::question::quoted(&word));
        let toward = format!("--toward {}", list(&self.toward));
        [control, toward].into_iter().chain(at(&self.at)).chain(self.curve.begun()).collect()
    }
}

impl Kinematic {
    /// The options that change the answer, as typed.
    pub fn options(&self) -> Vec<String> {
        let toward = self.toward.iter().map(|[x, y, z]| {
            if *z == 0.0 { format!("--toward {x},{y}") } else { format!("--toward {x},{y},{z}") }
        });
        let all = (self.all != DIRECTIONS).then(|| format!("--all {}", self.all));
        let control = self.control.as_ref().map(|(id, point)| {
            let word = format!("{id}={}", list(point));
            format!("--control {}", super::question::quoted(&word))
        });
        let fc = self.fc.map(|f| format!("--fc {f}"));
        let linear = self.linear.then(|| "--linear".to_string());
        let more = [all, control, fc, at(&self.at), linear].into_iter().flatten();
        toward.chain(more).chain(skip_dead(self.skip_dead)).collect()
    }
}

impl Stages {
    /// The options that change the answer, as typed.
    pub fn options(&self) -> Vec<String> {
        let toward = self.toward.iter().map(|[x, y, z]| {
            if *z == 0.0 { format!("--toward {x},{y}") } else { format!("--toward {x},{y},{z}") }
        });
        let all = self.all.map(|n| format!("--all {n}"));
        let given = [
            (self.remove_each, "--remove-each"),
            (self.any_order, "--any-order"),
            (self.skip_margin, "--skip-margin"),
            (self.skip_held, "--skip-held"),
        ];
        let words = given.iter().filter(|(given, _)| *given).map(|(_, word)| word.to_string());
        let order = (!self.order.is_empty())
            .then(|| format!("--order {}", super::question::quoted(&self.order.join(","))));
        let hands = self.hands.map(|n| format!("--hands {n}"));
        let tries = self.tries.map(|n| format!("--tries {n}"));
        let more = [all, order, hands, tries].into_iter().flatten();
        toward.chain(more).chain(words).collect()
    }
}

impl State {
    /// The options that change the answer, as typed.
    pub fn options(&self) -> Vec<String> {
        let control = self.control.as_ref().map(|(id, point)| {
            let word = format!("{id}={}", list(point));
            format!("--control {}", super::question::quoted(&word))
        });
        let corners =
            (self.quadrature == Quadrature::Corners).then(|| "--quadrature corners".into());
        let dead = self.dead_only.then(|| "--dead-only".to_string());
        [control, at(&self.at), corners, dead].into_iter().flatten().collect()
    }
}

impl Assess {
    /// The options that change the answer, as typed.
    pub fn options(&self) -> Vec<String> {
        let given = [(self.simulate, "--simulate"), (self.thorough, "--thorough")];
        let words = given.iter().filter(|(given, _)| *given).map(|(_, word)| word.to_string());
        worst(&self.worst).into_iter().chain(words).collect()
    }
}

impl Simulate {
    /// The options that change the answer, as typed.
    pub fn options(&self) -> Vec<String> {
        let given = [
            (self.fast, "--fast"),
            (self.fine, "--fine"),
            (self.to_the_end, "--to-the-end"),
            (self.skip_verdict, "--skip-verdict"),
        ];
        let words = given.iter().filter(|(given, _)| *given).map(|(_, word)| word.to_string());
        let seconds = self.seconds.map(|s| format!("--seconds {s}"));
        let load = (self.load_factor != 0.0).then(|| format!("--load-factor {}", self.load_factor));
        let toward = self.toward.map(|d| format!("--toward {}", list(&d)));
        let ground = self.ground.options();
        ground.into_iter().chain(toward).chain(words).chain(seconds).chain(load).collect()
    }
}

impl Ground {
    /// The options that change the answer, as typed.
    pub fn options(&self) -> Vec<String> {
        let file = |p: &std::path::PathBuf| {
            format!("--ground {}", super::question::quoted(&p.to_string_lossy()))
        };
        let pulse = self.pulse.as_ref().map(|(text, _)| format!("--pulse {text}"));
        let units =
            self.units.map(|u| format!("--units {}", super::question::quoted(&u.to_string())));
        let scale = self.scale.map(|k| format!("--scale {k}"));
        self.ground.iter().map(file).chain([pulse, units, scale].into_iter().flatten()).collect()
    }
}

impl Common {
    /// The options that change the answer, as typed.
    pub fn options(&self) -> Vec<String> {
        let law = matches!(self.law, Law::Associative).then(|| "--law associative".into());
        let keep_all = self.keep_all.then(|| "--keep-all".into());
        let time_limit = self.time_limit.map(|s| format!("--time-limit {s}"));
        let outside = self.outside.allow_outside.then(|| "--allow-outside".into());
        [law, keep_all, time_limit, outside].into_iter().flatten().collect()
    }
}
