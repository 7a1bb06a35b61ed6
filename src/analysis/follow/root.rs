//! Where a function goes through zero.

/// The bracket of a change of sign from `f(low) ≥ 0` to `f(high) < 0`, narrowed down to rounding
/// (regula falsi as the Illinois method has it, with bisection where that is slow); what `f` gave at
/// both ends comes along. None where `f` has no value.
pub fn narrow<T: Clone>(
    mut low: (f64, f64, T),
    mut high: (f64, f64, T),
    width: f64,
    f: impl Fn(f64, &T) -> Option<(f64, T)>,
) -> Option<[(f64, f64, T); 2]> {
    let (mut fl, mut fh) = (low.1, high.1);
    let mut last = 0;
    for round in 0..100 {
        let all = high.0 - low.0;
        if all <= width {
            break;
        }
        let secant = low.0 + all * fl / (fl - fh);
        // Every third time half, where the ends do not come nearer by themselves.
        let mut x = if round % 4 == 3 { low.0 + 0.5 * all } else { secant };
        let least = 0.3 * width;
        x = x.clamp(low.0 + least, high.0 - least);
        let (y, t) = f(x, &low.2)?;
        if y >= 0.0 {
            low = (x, y, t);
            fl = y;
            if last == 1 {
                fh *= 0.5;
            }
            last = 1;
        } else {
            high = (x, y, t);
            fh = y;
            if last == -1 {
                fl *= 0.5;
            }
            last = -1;
        }
    }
    Some([low, high])
}
