//! Stiff and extreme scenes with closed forms: no answer is wrong, next to none is missing.

use voussoir::study::extreme::{Ask, Grade, count, grid, run};

#[test]
fn the_extreme_grid() {
    let cells = grid();
    assert!(cells.len() >= 500, "{} cells", cells.len());
    let found = run(&cells, |_| {});
    for f in found.iter().filter(|f| f.grade != Grade::Right) {
        println!("{:?}: {} {}: {:?}, value {:?}, bracket {:?}", f.grade, f.family, f.what, f.ask, f.value, f.bracket);
    }
    for family in [None, Some("column"), Some("wall"), Some("arch")] {
        println!("{}: {:?}", family.unwrap_or("all"), count(&found, family));
    }
    let all = count(&found, None);
    assert_eq!(all.wrong, 0);
    assert!(all.undecided * 50 < all.cells, "{} of {} undecided", all.undecided, all.cells);
    assert!(all.narrow * 100 >= 98 * all.load_factors, "{} of {} brackets within 1e-6", all.narrow, all.load_factors);
    assert!(cells.iter().any(|c| matches!(c.ask, Ask::Stands(_, d) if d <= 1e-6)));
}
