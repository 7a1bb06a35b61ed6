//! Numbers for people: as many digits as are known, no more.

/// More digits than this are not shown, however narrow the bracket.
const DIGITS: i32 = 10;

/// Decimals that a bracket supports: its width is at most one unit of the last one.
pub fn decimals(value: f64, lower: f64, upper: f64) -> usize {
    let leading = |v: f64| v.abs().log10().floor().clamp(-300.0, 300.0) as i32;
    let width = upper - lower;
    let size = value.abs().max(lower.abs()).max(upper.abs());
    let size = if size > 0.0 && size.is_finite() { leading(size) } else { 0 };
    let most = DIGITS - 1 - size;
    let known = if width > 0.0 && width.is_finite() {
        -(width.log10().ceil().clamp(-300.0, 300.0) as i32)
    } else {
        most
    };
    usize::try_from(known.min(most)).unwrap_or(0)
}

/// A value with the digits its bracket supports.
pub fn bracketed(value: f64, lower: f64, upper: f64) -> String {
    fixed(value, decimals(value, lower, upper))
}

/// The ends of a bracket, rounded outwards so that what is printed encloses the value as well.
pub fn ends(value: f64, lower: f64, upper: f64) -> [String; 2] {
    let d = (decimals(value, lower, upper) + 2).min(300);
    [rounded(lower, d, -1.0, 0.0), rounded(upper, d, 1.0, 0.0)]
}

/// A value with so many decimals, rounded one way (1: up, -1: down) where nearest is more than
/// `allowed` in the other.
fn rounded(value: f64, decimals: usize, way: f64, allowed: f64) -> String {
    let text = fixed(value, decimals);
    // Decimal rounding goes to nearest: one unit further if it went the other way.
    let nearest: f64 = text.parse().unwrap_or(value);
    if (nearest - value) * way < -allowed {
        fixed(nearest + way * 10f64.powi(-(decimals as i32)), decimals)
    } else {
        text
    }
}

/// A value with so many decimals, without the sign of a negative zero.
pub fn fixed(value: f64, decimals: usize) -> String {
    // Far from one, decimals would be all zeros; the last digit of the mantissa has the same unit.
    if value != 0.0 && !(1e-4..1e12).contains(&value.abs()) {
        let digits = decimals as i32 + value.abs().log10().floor() as i32;
        if digits < 0 && value.abs() < 1.0 {
            // Less than the last digit that is known.
            return format!("{:.decimals$}", 0.0);
        }
        let digits = digits.clamp(0, 15) as usize;
        return format!("{value:.digits$e}");
    }
    let text = format!("{value:.decimals$}");
    if text.trim_start_matches('-').chars().all(|c| c == '0' || c == '.') {
        text.trim_start_matches('-').to_string()
    } else {
        text
    }
}

/// The number with the fewest digits that is no farther than this from a value.
pub fn roundest(value: f64, within: f64) -> f64 {
    let near = (0..17).filter_map(|digits| format!("{value:.digits$e}").parse().ok());
    near.into_iter().find(|near: &f64| (near - value).abs() <= within).unwrap_or(value)
}

/// Digits of an answer that people are shown; files, and `--verbose`, have all that are known.
const SHOWN: i32 = 4;

/// Four digits of a value that something bears or holds up to, never rounded up.
pub fn rounded_down(value: f64) -> String {
    four(value, -1.0)
}

/// Four digits of a value that something is at most, or holds from there on, never rounded down.
pub fn rounded_up(value: f64) -> String {
    four(value, 1.0)
}

/// Four digits of a value, rounded one way (1: up, -1: down), without zeros at the end; numbers above
/// 10,000 keep their whole part.
fn four(value: f64, way: f64) -> String {
    let size = value.abs();
    if !(size > 0.0 && size.is_finite()) {
        return fixed(value, 0);
    }
    let leading = size.log10().floor().max(-300.0) as i32;
    let text =
        rounded(value, (SHOWN - 1 - leading).max(0).unsigned_abs() as usize, way, LAST * size);
    match text.split_once('e') {
        None if text.contains('.') => text.trim_end_matches('0').trim_end_matches('.').to_string(),
        _ => text,
    }
}

/// What a computed value may be printed beyond itself, relative. Larger: it is printed where nothing was
/// computed. Smaller: a half that is 0.4999999999 is printed as 0.49999.
const LAST: f64 = 1e-9;

/// A few digits, for lengths and directions: `1.25`, `-0.5`, `0`.
pub fn short(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value:.0}").trim_start_matches('-').to_string();
    }
    if !(1e-3..1e6).contains(&value.abs()) {
        return format!("{value:.3e}");
    }
    let digits = (3 - value.abs().log10().floor() as i32).max(0) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_string()
    } else {
        text
    }
}

/// A point or a direction. Coordinates that are rounding beside the others are written 0.
pub fn point(p: [f64; 3]) -> String {
    let size = p.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let p = p.map(|c| if c.abs() <= 1e-9 * size { 0.0 } else { c });
    format!("({}, {}, {})", short(p[0]), short(p[1]), short(p[2]))
}

/// Words at the start of a sentence.
pub fn capital(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |c| c.to_uppercase().chain(letters).collect())
}

/// A time.
pub fn seconds(s: f64) -> String {
    if s >= 100.0 {
        format!("{s:.0} s")
    } else if s >= 1.0 {
        format!("{s:.1} s")
    } else if s >= 0.0995 {
        format!("{:.0} ms", s * 1e3)
    } else {
        format!("{:.1} ms", s * 1e3)
    }
}

/// `1 block`, `2 blocks`.
pub fn count(n: usize, noun: &str) -> String {
    format!("{n} {noun}{}", if n == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_roundest_number_is_no_farther_than_asked() {
        assert_eq!(roundest(0.328_322_9, 1.6e-3), 0.328);
        assert_eq!(roundest(0.505_112_201_3, 0.1), 0.5);
        assert_eq!(roundest(-12_345.678, 60.0), -12_300.0);
        assert_eq!(roundest(1e-9 / 3.0, 4e-12), 3.3e-10);
        assert_eq!(roundest(0.1 + 0.2, 0.0), 0.1 + 0.2);
        assert_eq!(roundest(0.0, 0.0), 0.0);
        assert!(roundest(f64::INFINITY, 1.0).is_infinite() && roundest(f64::NAN, 1.0).is_nan());
    }

    #[test]
    fn shows_the_digits_that_the_bracket_supports() {
        assert_eq!(bracketed(0.149_969_235_7, 0.149_969_235, 0.149_969_236), "0.149969236");
        assert_eq!(bracketed(0.002, 0.001_999_999, 0.002_000_001), "0.00200000");
        assert_eq!(bracketed(12345.678, 12000.0, 13000.0), "12346");
        assert_eq!(bracketed(0.5, 0.5, 0.5), "0.5000000000");
        assert_eq!(bracketed(2.3456e-7, 2.3455e-7, 2.3457e-7), "2.346e-7");
        assert_eq!(bracketed(-1e-14, -1e-10, 1e-10), "0.000000000");
    }

    #[test]
    fn small_load_factors_keep_their_digits() {
        let said = [0.4376801, 0.01748, 1.7e-3, -0.148, 3.2e-9, 41_818.594, 0.0, -0.0];
        let wanted = ["0.4376", "0.01748", "0.0017", "-0.148", "3.200e-9", "41818", "0", "0"];
        assert_eq!(said.map(rounded_down), wanted);
    }

    #[test]
    fn what_is_printed_is_on_its_safe_side() {
        assert_eq!(rounded_down(0.353_578_553_7), "0.3535");
        assert_eq!(rounded_down(0.499_999_999_9), "0.5");
        assert_eq!(rounded_down(-0.148_01), "-0.1481");
        assert_eq!(rounded_down(9.9999e-3), "0.009999");
        assert_eq!(rounded_down(0.5f64.atan().to_degrees()), "26.56");
        assert_eq!(rounded_down(44.999_999_99), "45");
        assert_eq!(rounded_up(0.356_101), "0.3562");
        assert_eq!(rounded_up(0.356_1), "0.3561");
        assert_eq!(rounded_up(9.999_99e-3), "0.01");
        assert_eq!(rounded_up(0.5f64.atan().to_degrees()), "26.57");
    }

    #[test]
    fn printed_ends_enclose_the_bracket() {
        for (lower, upper) in [
            (0.149_969_235_2, 0.149_969_235_9),
            (-0.3, 0.7),
            (1.0, 1.0),
            (-2.5e-9, 3.5e-9),
            (2.345e-7, 2.346e-7),
            (99.999_999, 100.000_001),
        ] {
            let [l, u] = ends(0.5 * (lower + upper), lower, upper);
            assert!(
                l.parse::<f64>().unwrap() <= lower && u.parse::<f64>().unwrap() >= upper,
                "{l} {u}"
            );
        }
    }

    #[test]
    fn short_numbers() {
        let all = [1.25, -0.5, 0.0, -0.0, 1.0 / 3.0, 123_456.0, 1e-9, 2.0].map(short);
        assert_eq!(all, ["1.25", "-0.5", "0", "0", "0.3333", "123456", "1.000e-9", "2"]);
        assert_eq!(point([1.0, 1e-17, -2.0]), "(1, 0, -2)");
    }
}
