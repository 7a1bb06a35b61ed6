//! The method against known answers and against the other engine.

use super::*;
use crate::{
    EngineSettings, Status,
    program::{
        LiveLoad, Statics, StaticsOptions, Unknowns,
        coulomb::{Contacts, HeldQuantity, Objective},
        equilibrium_error, load_factor,
    },
    solve,
};
use model::interface::{Model, prepare};
use scene::read_str;

/// A running-bond wall of blocks 1 × 0.5 × 0.4 m on a fixed course.
fn wall(courses: usize, length: usize, push: [f64; 3]) -> Model {
    let text = format!(
        r#"{{ "format": "voussoir-scene/1", "joints": {{ "default": {{ "friction": 0.6 }} }},
        "templates": [ {{ "wall": {{ "size": [1, 0.5, 0.4], "courses": {courses}, "blocks": {length}, "first": "half", "base": "course" }} }} ],
        "loads": {{ "live": [ {{ "weight": {push:?} }} ] }} }}"#
    );
    prepare(&read_str("wall", text).unwrap().0).unwrap()
}

fn settings(engine: EngineSettings) -> Settings {
    Settings { engine, tolerance: 1e-9, ..Settings::default() }
}

/// By this method itself: no other engine steps in.
fn own(program: &ConicProgram, settings: &Settings) -> Solution {
    Session::new(program, settings).expect("a program of contacts").solve()
}

fn pushed(courses: usize, length: usize, push: [f64; 3]) -> ConicProgram {
    let model = wall(courses, length, push);
    let statics = Statics::new(&model, StaticsOptions { live: true, ..StaticsOptions::default() });
    load_factor(&statics, 1.0, Unknowns::Forces).0
}

#[test]
fn a_wall_pushed_over_turns_about_its_foot() {
    // Thickness over height: every course turns with the others about the lowest edge.
    let program = pushed(8, 6, [0.0, 1.0, 0.0]);
    let solution = own(&program, &settings(EngineSettings::Interior));
    assert_eq!(solution.status, Status::Solved);
    let lambda = *solution.x.last().unwrap();
    assert!((lambda - 0.5 / (8.0 * 0.4)).abs() < 1e-8, "{lambda}");
    // Strong duality: the multipliers say the same.
    let dual: f64 = program.rhs.iter().zip(&solution.z).map(|(b, z)| b * z).sum();
    assert!((dual - lambda).abs() < 1e-8, "{dual}");
}

#[test]
fn both_engines_find_the_same_load_factor() {
    for (program, columns) in
        [(pushed(10, 10, [1.0, 0.0, 0.0]), 1), (pushed(5, 7, [0.6, 0.8, 0.0]), 1)]
    {
        let [a, b] = [
            own(&program, &settings(EngineSettings::Interior)),
            solve(&program, &settings(EngineSettings::default())),
        ];
        assert_eq!(a.status, Status::Solved);
        let last = program.matrix.columns - columns;
        assert!((a.x[last] - b.x[last]).abs() < 1e-7, "{} {}", a.x[last], b.x[last]);
    }
}

#[test]
fn both_engines_find_the_same_least_equilibrium_error() {
    // A wall on its side: gravity along its face slides the courses off each other.
    for (down, stands) in [("[0, 0, -9.81]", true), ("[0, -9.0, -4.0]", false)] {
        let text = format!(
            r#"{{ "format": "voussoir-scene/1", "gravity": {down}, "joints": {{ "default": {{ "friction": 0.6 }} }},
            "templates": [ {{ "wall": {{ "size": [1, 0.5, 0.4], "courses": 6, "blocks": 6, "base": "course" }} }} ] }}"#
        );
        let model = prepare(&read_str("wall", text).unwrap().0).unwrap();
        let statics = Statics::new(&model, StaticsOptions::default());
        let (program, layout) = equilibrium_error(&statics, LiveLoad::Absent, Unknowns::Forces);
        let [a, b] = [
            own(&program, &settings(EngineSettings::Interior)),
            solve(&program, &settings(EngineSettings::default())),
        ];
        assert_eq!(a.status, Status::Solved, "{:?}", a.trace.last());
        let value =
            |s: &Solution| program.objective.iter().zip(&s.x).map(|(c, x)| c * x).sum::<f64>();
        assert!((value(&a) - value(&b)).abs() < 1e-7, "{} {}", value(&a), value(&b));
        assert_eq!(value(&a) < 1e-9, stands, "{}", value(&a));
        assert_eq!(layout.forces(&a.x, &a.z).len(), statics.matrix.columns);
    }
}

#[test]
fn both_engines_find_the_same_state_again_and_again() {
    let model = wall(6, 6, [1.0, 0.0, 0.0]);
    let contacts =
        Contacts::new(&model, StaticsOptions { keep_all: true, ..StaticsOptions::default() });
    let limit = vec![0.7; contacts.discs().count()];
    let mut program = contacts.program(Objective::State(1e-2), HeldQuantity::Limits, &limit);
    let mut session = Session::new(&program, &settings(EngineSettings::Interior)).unwrap();
    // The second solve begins where the first passed, the third changes nothing.
    for limit in [0.7, 0.3, 0.3] {
        contacts.hold(&mut program, HeldQuantity::Limits, &vec![limit; contacts.discs().count()]);
        assert!(session.set_rhs(&program.rhs));
        let [a, b] = [session.solve(), solve(&program, &settings(EngineSettings::default()))];
        assert_eq!(a.status, Status::Solved);
        let forces = contacts.statics.matrix.columns;
        for (a, b) in a.x[..forces].iter().zip(&b.x) {
            assert!((a - b).abs() < 1e-4, "{a} {b}");
        }
    }
    assert!(!session.set_rhs(&[1.0]) && !session.set_objective(&[]));
}

#[test]
fn rates_fit_those_of_the_blocks_however_stiff_a_contact_is() {
    let st = Structure::new(&pushed(5, 5, [0.6, 0.8, 0.0])).unwrap();
    let mut reduced = reduced::Reduced::new(&st).unwrap();
    let mut cones = Cones::new(&st.cones);
    // Near the end of a path: every contact is about to slip.
    let (mut s, mut z) = (vec![0.0; st.cone_rows.len()], vec![0.0; st.cone_rows.len()]);
    for (k, cone) in st.cones.iter().enumerate() {
        let (sin, cos) = (k as f64).sin_cos();
        let slip = |n: f64, t: f64| [n, n * t * cos, n * t * sin];
        s[cone.first..cone.first + cone.size].copy_from_slice(&slip(0.7, 1.0 - 1e-10)[..cone.size]);
        z[cone.first..cone.first + cone.size].copy_from_slice(&slip(0.2, 1e-10 - 1.0)[..cone.size]);
    }
    assert!(cones.scale(&s, &z));
    let mut newton = newton::Newton::new(&st, &mut reduced, &cones).unwrap();
    let wave = |n: usize, by: f64| (0..n).map(|k| (by * k as f64).sin()).collect::<Vec<_>>();
    let a = Iterate {
        x: wave(st.variables.len(), 0.7),
        t: wave(st.border.len(), 1.0),
        y: wave(st.equalities.len(), 1.3),
        z: s.clone(),
    };
    let d = newton.solve(&a, newton::EXACT, 0.0);
    let mut lack = a.x.clone();
    st.e.add_transposed(-1.0, &d.y, &mut lack);
    st.g.add_transposed(-1.0, &d.z, &mut lack);
    assert!(greatest(&lack) < 1e-12 * greatest(&d.z), "{} of {}", greatest(&lack), greatest(&d.z));
}

#[test]
fn a_program_alike_begins_near_what_another_passed() {
    let [one, other] =
        [[0.2, 1.0, 0.0], [-0.2, 1.0, 0.0]].map(|direction| pushed(14, 14, direction));
    let session = || Session::new(&other, &settings(EngineSettings::Interior)).unwrap();
    let passed = own(&one, &settings(EngineSettings::Interior)).passed.unwrap();
    let last = other.matrix.columns - 1;
    let alone = session().solve();
    let mut near = session();
    assert!(near.begin_near(&passed));
    let found = near.solve();
    assert_eq!((alone.status, found.status), (Status::Solved, Status::Solved));
    assert!((alone.x[last] - found.x[last]).abs() < 1e-7, "{} {}", alone.x[last], found.x[last]);
    assert!(
        found.trace.len() < alone.trace.len(),
        "{} of {}",
        found.trace.len(),
        alone.trace.len()
    );
    // What leads nowhere is solved from its own start.
    let mut poor = session();
    assert!(poor.begin_near(&Passed { x: vec![f64::NAN; passed.x.len()], ..passed.clone() }));
    let found = poor.solve();
    assert_eq!(found.status, Status::Solved);
    assert_eq!(found.x[last].to_bits(), alone.x[last].to_bits());
    assert_eq!(found.trace.len(), alone.trace.len() + 1);
    // A point of another program is none of this one.
    assert!(!session().begin_near(&Passed { z: Vec::new(), ..passed }));
}

#[test]
fn the_same_program_gives_the_same_bits() {
    let program = pushed(6, 6, [1.0, 0.0, 0.0]);
    let bits = || {
        own(&program, &settings(EngineSettings::Interior))
            .x
            .iter()
            .map(|v| v.to_bits())
            .collect::<Vec<_>>()
    };
    assert_eq!(bits(), bits());
}

#[test]
fn what_has_no_answer_ends_without_one() {
    // Nothing holds the live load: its multiple may grow for ever.
    let mut program = pushed(6, 6, [1.0, 0.0, 0.0]);
    let lambda = program.matrix.columns - 1;
    program
        .matrix
        .j
        .iter()
        .zip(&mut program.matrix.v)
        .filter(|(j, _)| **j == lambda)
        .for_each(|(_, v)| *v = 1e-300);
    let solution = own(&program, &settings(EngineSettings::Interior));
    assert_ne!(solution.status, Status::Solved);
    // No time.
    let program = pushed(6, 6, [1.0, 0.0, 0.0]);
    assert_eq!(
        own(
            &program,
            &Settings {
                deadline: crate::deadline::Deadline::within(0.0),
                ..settings(EngineSettings::Interior)
            }
        )
        .status,
        Status::Limit
    );
    // Numbers that are none.
    let mut program = program;
    program.rhs[0] = f64::NAN;
    assert_ne!(own(&program, &settings(EngineSettings::Interior)).status, Status::Solved);
}

#[test]
fn of_what_falls_no_more_is_sought_than_that_it_does() {
    // On its side, with gravity along its face: the courses slide whatever pulls at them along it.
    let text = r#"{ "format": "voussoir-scene/1", "gravity": [0, -9.0, -4.0], "joints": { "default": { "friction": 0.6 } },
        "templates": [ { "wall": { "size": [1, 0.5, 0.4], "courses": 6, "blocks": 6, "base": "course" } } ],
        "loads": { "live": [ { "weight": [1, 0, 0] } ] } }"#;
    let model = prepare(&read_str("wall", text).unwrap().0).unwrap();
    let statics = Statics::new(&model, StaticsOptions { live: true, ..StaticsOptions::default() });
    let exact = settings(EngineSettings::Interior);
    let (limit, _) = load_factor(&statics, 1.0, Unknowns::Forces);
    assert_eq!(own(&limit, &exact).status, Status::PrimalInfeasible);
    let (least, _) = equilibrium_error(&statics, LiveLoad::AnyMultiple, Unknowns::Forces);
    let [whole, sign] = [0.0, 1e-5]
        .map(|where_positive| own(&least, &Settings { where_positive, tolerance: 1e-11, ..exact }));
    assert_eq!((whole.status, sign.status), (Status::Solved, Status::Solved));
    assert!(sign.trace.len() < whole.trace.len(), "{}", whole.trace.len());
    let value = |s: &Solution| s.trace[s.trace.len() - 1].dual;
    assert!(value(&sign) > 1e-2 && (value(&sign) / value(&whole) - 1.0).abs() < 1e-4);
}

#[test]
fn other_programs_are_left_to_the_other_engine() {
    let mut program = pushed(6, 6, [1.0, 0.0, 0.0]);
    // In rates every block is tied to its neighbours by their contacts.
    let model = wall(6, 6, [1.0, 0.0, 0.0]);
    let statics = Statics::new(&model, StaticsOptions { live: true, ..StaticsOptions::default() });
    let (rates, _) = load_factor(&statics, 1.0, Unknowns::Rates);
    assert!(Session::new(&rates, &settings(EngineSettings::Interior)).is_none());
    assert_eq!(solve(&rates, &settings(EngineSettings::Interior)).status, Status::Solved);
    // A variable that nothing holds has no stiffness.
    program.objective.push(0.0);
    program.matrix.columns += 1;
    assert!(own(&program, &settings(EngineSettings::Interior)).x.is_empty());
}
