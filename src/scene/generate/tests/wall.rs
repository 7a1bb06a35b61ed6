//! Walls: bond, base, openings, rakes.

use super::*;
use crate::template::WallBase;

/// The courses of a wall from the bottom up, each as the x-ranges of its blocks.
fn courses(blocks: &[BlockSpec], free: bool) -> Vec<Vec<(f64, f64)>> {
    let mut courses: Vec<(f64, Vec<(f64, f64)>)> = Vec::new();
    for block in blocks.iter().filter(|b| b.support != free) {
        let o = outline(block);
        if courses.last().is_none_or(|(z, _)| *z != o[0][1]) {
            courses.push((o[0][1], Vec::new()));
        }
        courses.last_mut().expect("just pushed").1.push((o[0][0], o[1][0]));
    }
    courses.into_iter().map(|(_, c)| c).collect()
}

fn bricks(blocks: usize, courses: usize, first: WallEnd) -> Wall {
    Wall { size: [4.0, 1.0, 1.75], blocks, courses, first, ..Wall::default() }
}

#[test]
fn running_bond_alternates_and_cuts_half_blocks() {
    // Ferris & Tin-Loi wall 1.
    let wall = build(Template::Wall(bricks(5, 6, WallEnd::Half)));
    assert_eq!(wall.len(), 34);
    assert_corners(&wall, "base", &[[0.0, -1.75], [20.0, -1.75], [20.0, 0.0], [0.0, 0.0]]);
    let halves =
        vec![(0.0, 2.0), (2.0, 6.0), (6.0, 10.0), (10.0, 14.0), (14.0, 18.0), (18.0, 20.0)];
    let wholes = vec![(0.0, 4.0), (4.0, 8.0), (8.0, 12.0), (12.0, 16.0), (16.0, 20.0)];
    let rows = courses(&wall, true);
    assert_eq!(rows[0], halves);
    assert_eq!(rows[5], wholes);
    assert_corners(&wall, "c05_04", &[[16.0, 8.75], [20.0, 8.75], [20.0, 10.5], [16.0, 10.5]]);
}

#[test]
fn a_course_as_base_continues_the_bond() {
    let wall = build(Template::Wall(Wall {
        size: [1.0, 0.5, 0.4],
        base: WallBase::Course,
        ..bricks(100, 100, WallEnd::Half)
    }));
    let base = courses(&wall, false);
    assert_eq!((base.len(), base[0].len()), (1, 100));
    let free = courses(&wall, true);
    assert_eq!((free.len(), free[0].len(), free[1].len()), (100, 101, 100));
    assert_eq!(wall.iter().filter(|b| b.support).map(|b| b.id.as_str()).next(), Some("base_000"));
}

#[test]
fn openings_cut_the_blocks_they_cross() {
    // Ferris & Tin-Loi wall 3: 46 blocks, an opening of 4 × 8.75 m.
    let openings = vec![Opening { x: 6.0, z: 5.25, width: 4.0, height: 8.75 }];
    let wall = build(Template::Wall(Wall { openings, ..bricks(4, 11, WallEnd::Whole) }));
    assert_eq!(wall.len(), 47);
    let rows = courses(&wall, true);
    assert_eq!(rows[2], [(0.0, 4.0), (4.0, 8.0), (8.0, 12.0), (12.0, 16.0)]);
    assert_eq!(rows[3], [(0.0, 2.0), (2.0, 6.0), (10.0, 14.0), (14.0, 16.0)]);
    assert_eq!(rows[4], [(0.0, 4.0), (4.0, 6.0), (10.0, 12.0), (12.0, 16.0)]);
    assert_eq!(rows[8], [(0.0, 4.0), (4.0, 8.0), (8.0, 12.0), (12.0, 16.0)]);
    // Wall 5: 61 blocks, two openings.
    let opening = |z| Opening { x: 4.0, z, width: 4.0, height: 8.75 };
    let wall = build(Template::Wall(Wall {
        openings: vec![opening(5.25), opening(19.25)],
        ..bricks(3, 19, WallEnd::Half)
    }));
    assert_eq!(wall.len(), 62);
    assert_eq!(courses(&wall, true)[4], [(0.0, 2.0), (2.0, 4.0), (8.0, 10.0), (10.0, 12.0)]);
}

#[test]
fn an_opening_on_the_grid_leaves_no_sliver() {
    // 3 × 0.1 is not 0.3: the edge misses the joint by rounding.
    let opening = Opening { x: 0.1 * 3.0, z: 0.1 * 3.0, width: 0.3, height: 0.1 };
    let wall =
        Wall { size: [0.3, 0.1, 0.1], openings: vec![opening], ..bricks(3, 5, WallEnd::Half) };
    let rows = courses(&build(Template::Wall(wall)), true);
    assert_eq!(rows[3].len(), 2, "{:?}", rows[3]);
}

#[test]
fn raked_ends_step_in_by_half_a_block() {
    let wall = build(Template::Wall(Wall { rake_right: 0.5, ..bricks(6, 6, WallEnd::Half) }));
    assert_eq!(wall.len(), 34);
    let rows = courses(&wall, true);
    assert_eq!(rows[0].last(), Some(&(22.0, 24.0)));
    assert_eq!(rows[1].last(), Some(&(20.0, 22.0)));
    assert_eq!(rows[5], [(0.0, 4.0), (4.0, 8.0), (8.0, 12.0), (12.0, 14.0)]);
}
