//! Charts of how an answer came about, and of heaps.

use crate::{
    chart::{Axis, Chart, Series},
    heaps::ReposeFile,
};
use analysis::{Attempt, repose::seen::Seen};
use base::number::{seconds, short};
use check::proof::ResultFile;

/// Width of the bracket against the time spent, from the attempts at each program.
pub fn attempts(file: &ResultFile) -> Option<Chart> {
    // Those of many scenes beside each other say nothing.
    if file.stages.is_some() {
        return None;
    }
    let mut series: Vec<Series> = Vec::new();
    let mut spent = 0.0;
    // Attempts that follow each other at the same question share a line.
    let mut last: Option<&str> = None;
    for a in &file.run.trace {
        let about = a.program.split(" in ").next().unwrap_or(&a.program);
        if last != Some(about) || a.force_unit.is_nan() {
            spent = 0.0;
            last = Some(about);
        }
        spent += a.seconds;
        let width = a.upper - a.lower;
        if !(width.is_finite() && width > 0.0 && spent > 0.0) {
            continue;
        }
        let line = match series.iter().position(|s| s.name == about) {
            Some(k) => &mut series[k],
            None => {
                series.push(Series { name: about.to_string(), line: true, ..Series::default() });
                let end = series.len() - 1;
                &mut series[end]
            }
        };
        line.points.push([Some(spent), Some(width)]);
        line.hints.push(hint(a, spent, width));
    }
    let states: Vec<_> =
        file.run.state_steps.iter().filter(|s| s.acceleration > 0.0 && s.seconds > 0.0).collect();
    if !states.is_empty() {
        let mut line = Series {
            name: "equilibrium error with dry friction, g".into(),
            line: true,
            ..Series::default()
        };
        let mut spent = 0.0;
        for s in states {
            spent += s.seconds;
            line.points.push([Some(spent), Some(s.acceleration)]);
            line.hints.push(format!(
                "after {}: equilibrium error {:.1e} g, ε = {:.0e}, {} programs",
                seconds(spent),
                s.acceleration,
                s.epsilon,
                s.solves
            ));
        }
        series.push(line);
    }
    if series.is_empty() {
        return None;
    }
    Some(Chart {
        title: "Error against time".into(),
        x: Axis::new("seconds", true),
        y: Axis::new("error: width of the bracket", true),
        series,
        note: "Each point is an attempt; its bracket is recomputed from the scene, not taken from the solver.".into(),
        ..Chart::default()
    })
}

fn hint(a: &Attempt, spent: f64, width: f64) -> String {
    format!(
        "{}: bracket {width:.1e} wide after {}; {} iterations, solver status {:?}",
        a.program,
        seconds(spent),
        a.iterations,
        a.engine_status
    )
}

/// The angle of every heap, or what drums, hoppers and shear boxes show on their way.
pub fn heaps(file: &ReposeFile) -> Vec<Chart> {
    angles(file).into_iter().chain(flows(file)).collect()
}

fn angles(file: &ReposeFile) -> Option<Chart> {
    let there: Vec<_> = file.heaps.iter().filter_map(|h| Some((h, h.angle_deg?))).collect();
    if there.is_empty() {
        return None;
    }
    let series = Series {
        name: "angle of repose".into(),
        points: there.iter().map(|(h, angle)| [Some(h.seed as f64), Some(*angle)]).collect(),
        hints: there
            .iter()
            .map(|(h, angle)| format!("seed {}: {}°, {} grains", h.seed, short(*angle), h.grains))
            .collect(),
        ..Series::default()
    };
    Some(Chart {
        title: "Angle of every heap".into(),
        x: Axis::new("seed", false),
        y: Axis::new("degrees", false),
        series: vec![series],
        ..Chart::default()
    })
}

/// What one chart shows of what flows.
struct Course {
    title: &'static str,
    axes: [&'static str; 2],
    note: &'static str,
    points: Vec<[f64; 2]>,
}

/// The courses of one run; always the same ones of a kind.
fn courses(seen: &Seen) -> Vec<Course> {
    match seen {
        Seen::Drum { course, .. } => vec![Course {
            title: "Slope of the surface as the drum turns",
            axes: ["rotation of the drum, degrees", "slope, degrees"],
            note: "The mean is over the whole rotation.",
            points: course.clone(),
        }],
        Seen::Hopper { course, .. } => vec![Course {
            title: "Discharged mass",
            axes: ["time since opening, s", "kg"],
            note: "The discharge rate is the slope between 0.1 and 0.5 of the mass filled in.",
            points: course.clone(),
        }],
        Seen::Cell(flown) => of_cell(&flown.course),
        Seen::Shear { course, .. } => vec![
            Course {
                title: "Resistance to shear",
                axes: ["displacement, m", "shear over normal force"],
                note: "The residual value is the mean over the last two fifths of the displacement.",
                points: course.iter().map(|c| [c[0], c[1]]).collect(),
            },
            Course {
                title: "Rise of the lid",
                axes: ["displacement, m", "m"],
                note: "The dilatancy is the steepest slope of this curve.",
                points: course.iter().map(|c| [c[0], c[2]]).collect(),
            },
        ],
    }
}

fn of_cell(course: &[[f64; 3]]) -> Vec<Course> {
    vec![
        Course {
            title: "Resistance to shear",
            axes: ["shear strain", "shear over normal stress"],
            note: "Means are over all but the first strain of one.",
            points: course.iter().map(|c| [c[0], c[1]]).collect(),
        },
        Course {
            title: "Solid fraction",
            axes: ["shear strain", "solid fraction"],
            note: "Share of the volume that grains fill.",
            points: course.iter().map(|c| [c[0], c[2]]).collect(),
        },
    ]
}

/// The courses of what flows, a line for every seed.
fn flows(file: &ReposeFile) -> Vec<Chart> {
    let mut charts: Vec<Chart> = Vec::new();
    for (seed, seen) in file.heaps.iter().filter_map(|h| Some((h.seed, h.seen.as_ref()?))) {
        for (k, course) in courses(seen).into_iter().enumerate() {
            if k == charts.len() {
                let [along, up] = course.axes;
                charts.push(Chart {
                    title: course.title.into(),
                    x: Axis::new(along, false),
                    y: Axis::new(up, false),
                    note: course.note.into(),
                    ..Chart::default()
                });
            }
            let hint = |p: &[f64; 2]| format!("seed {seed}: {} at {}", short(p[1]), short(p[0]));
            charts[k].series.push(Series {
                name: format!("seed {seed}"),
                line: true,
                hints: course.points.iter().map(hint).collect(),
                points: course.points.into_iter().map(|p| p.map(Some)).collect(),
                ..Series::default()
            });
        }
    }
    charts
}
