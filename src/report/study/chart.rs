//! Charts of studies: error against time on logarithmic axes, and the performance profile.

use super::ANSWER;
use crate::chart::{Axis, Chart, Series};
use base::number::{seconds, short};
use sweep::study::{StudyMethod, StudyPoint, profile};

/// Errors below this are drawn here: rounding.
pub(crate) const FLOOR: f64 = 1e-15;

/// Error against time on one scene, a line per method.
pub fn errors(scene: &str, points: &[StudyPoint]) -> Chart {
    let of = |method: StudyMethod| {
        let mut own: Vec<&StudyPoint> = points
            .iter()
            .filter(|p| p.scene == scene && p.method == method && p.seconds > 0.0)
            .collect();
        own.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
        let known: Vec<(&StudyPoint, f64)> =
            own.into_iter().filter_map(|p| Some((p, p.error?))).collect();
        Series {
            name: method.label().into(),
            line: true,
            points: known
                .iter()
                .map(|(p, e)| [p.seconds, e.clamp(FLOOR, 10.0)].map(Some))
                .collect(),
            hints: known
                .iter()
                .map(|(p, e)| {
                    let knob = if method.knob().is_empty() {
                        String::new()
                    } else {
                        format!(", {} {}", method.knob(), short(p.knob))
                    };
                    format!("{}{knob}: error {e:.1e} in {}", method.label(), seconds(p.seconds))
                })
                .collect(),
            ..Series::default()
        }
    };
    Chart {
        title: scene.into(),
        x: Axis::new("seconds", true),
        y: Axis::new("relative error of the load factor", true),
        series: StudyMethod::ALL.into_iter().map(of).filter(|s| !s.points.is_empty()).collect(),
        ..Chart::default()
    }
}

/// Which share of the scenes a method answers within a multiple of the fastest method's time.
pub fn profiles(points: &[StudyPoint]) -> Chart {
    let ratios: Vec<f64> = (0..=60).map(|k| 10f64.powf(f64::from(k) / 20.0)).collect();
    let series = profile(points, ANSWER, &ratios).into_iter().map(|(method, shares)| Series {
        name: method.label().into(),
        line: true,
        hints: ratios
            .iter()
            .zip(&shares)
            .map(|(r, s)| {
                format!(
                    "{}: {} % of the scenes within {} × the fastest time",
                    method.label(),
                    short(100.0 * s),
                    short(*r)
                )
            })
            .collect(),
        points: ratios.iter().zip(&shares).map(|(r, s)| [*r, *s].map(Some)).collect(),
        ..Series::default()
    });
    Chart {
        title: format!("Scenes solved to a relative error of {ANSWER:.0e}"),
        x: Axis::new("time relative to the fastest method", true),
        y: Axis::new("share of the scenes", false),
        series: series.collect(),
        note: "Performance profile after Dolan and Moré (2002).".into(),
        ..Chart::default()
    }
}

/// Error against time, a colour for each named series of dots (seconds, relative error).
pub(super) fn dots(
    title: &str,
    x: &str,
    series: impl Iterator<Item = (String, Vec<(f64, f64)>)>,
) -> Chart {
    let drawn = |(name, list): (String, Vec<(f64, f64)>)| {
        let there = list.into_iter().filter(|d| d.0 > 0.0);
        let dots: Vec<(f64, f64)> = there.map(|(s, e)| (s, e.clamp(FLOOR, 10.0))).collect();
        Series::dots(name, &dots, |s, e| format!("error {e:.1e} in {}", seconds(s)))
    };
    Chart {
        title: title.into(),
        x: Axis::new(x, true),
        y: Axis::new("relative error", true),
        series: series.map(drawn).filter(|s| !s.points.is_empty()).collect(),
        ..Chart::default()
    }
}
