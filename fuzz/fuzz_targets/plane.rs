//! The plane kernel by itself: hull, clipping, area.
#![no_main]
use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use voussoir::plane::{
    clip::clip,
    polygon::{P2, area, hull},
};

#[derive(Arbitrary, Debug)]
struct Point(i8, i8, u8);

impl Point {
    fn value(&self) -> P2 {
        let nudge = if self.2 < 200 { 0.0 } else { 10f64.powi(-i32::from(self.2 - 196) / 4) };
        P2::new(f64::from(self.0 % 8) + nudge, f64::from(self.1 % 8) - nudge)
    }
}

const TOL: f64 = 1e-9;

fuzz_target!(|input: (Vec<Point>, Vec<Point>)| {
    let [a, b] = [&input.0, &input.1]
        .map(|list| hull(&list.iter().take(64).map(Point::value).collect::<Vec<_>>(), TOL));
    for h in [&a, &b] {
        assert!(h.iter().flat_map(|p| p.iter()).all(|x| x.is_finite()));
        assert!(h.len() < 3 || area(h) >= 0.0, "a hull runs clockwise: {h:?}");
    }
    if a.len() < 3 || b.len() < 3 {
        return;
    }
    let (ab, ba) = (clip(&a, &b, TOL), clip(&b, &a, TOL));
    let (x, y) = (area(&ab), area(&ba));
    let room = 100.0 * TOL * 64.0;
    assert!(x <= area(&a).min(area(&b)) + room && x >= -room, "{x}");
    assert!((x - y).abs() <= room, "the order of clipping matters: {x} {y}");
});
