//! Who may touch whom: lists of pairs that stay true until something has moved by half a skin
//! (Verlet 1967), found by cells that are as wide as the widest pair (Hockney & Eastwood 1981).
//!
//! * L. Verlet, *Computer "experiments" on classical fluids I*, Physical Review 159 (1967) 98.
//! * R. W. Hockney, J. W. Eastwood, *Computer simulation using particles*, McGraw-Hill 1981.

use crate::{
    cell::{Cell, Narrow},
    law::Memory,
    wall::Wall,
};
use nalgebra::Vector3;

/// Cells of the grid over grains. More: a grain that flies off leaves a grid of empty cells. Fewer:
/// cells that hold several grains.
const CELLS: usize = 4;
/// As many cells there may always be: while there are more, one direction has six, and half of them
/// still is three.
const LEAST: usize = 125;

/// The pairs, those of each grain side by side; second bodies from the number of grains on are
/// walls.
#[derive(Default)]
pub(crate) struct Neighbours {
    /// Where the pairs of each grain as the first begin.
    pub start: Vec<u32>,
    pub second: Vec<u32>,
    pub image: Vec<[i8; 3]>,
    pub memory: Vec<Memory>,
    pub touching: Vec<bool>,
    /// Where the pairs of each grain as the second begin, and which these are.
    pub incoming_start: Vec<u32>,
    pub incoming: Vec<u32>,
    grid: Grid,
    kept_start: Vec<u32>,
    kept: Vec<(u32, Memory)>,
}

/// What there is to be met.
pub(crate) struct Bodies<'a> {
    pub x: &'a [Vector3<f64>],
    pub radius: &'a [f64],
    /// 0 for what is fixed.
    pub inverse_mass: &'a [f64],
    pub gone: &'a [bool],
    pub walls: &'a [Wall],
    pub cell: &'a Cell,
    pub skin: f64,
}

/// Cells over the grains, each with its grains in a row.
#[derive(Default)]
struct Grid {
    low: [f64; 3],
    over: [f64; 3],
    count: [usize; 3],
    of: Vec<u32>,
    start: Vec<u32>,
    grains: Vec<u32>,
}

impl Neighbours {
    /// Finds the pairs anew; contacts keep what they remember.
    pub fn find(&mut self, bodies: &Bodies) -> Result<(), Narrow> {
        self.keep();
        self.grid.sort(bodies)?;
        let n = bodies.x.len();
        self.second.clear();
        self.image.clear();
        self.memory.clear();
        self.touching.clear();
        self.start.clear();
        self.start.push(0);
        for i in 0..n {
            if !bodies.gone[i] {
                self.meet(i, bodies);
                self.meet_walls(i, bodies);
            }
            self.start.push(self.second.len() as u32);
        }
        self.turn_round(n);
        Ok(())
    }

    /// Sets aside what contacts remember.
    fn keep(&mut self) {
        self.kept.clear();
        self.kept_start.clear();
        self.kept_start.push(0);
        for range in self.start.windows(2) {
            for p in range[0] as usize..range[1] as usize {
                if self.touching[p] {
                    self.kept.push((self.second[p], self.memory[p]));
                }
            }
            self.kept_start.push(self.kept.len() as u32);
        }
    }

    fn add(&mut self, i: usize, second: usize, image: [i8; 3]) {
        let range = match self.kept_start.get(i..i + 2) {
            Some(ends) => ends[0] as usize..ends[1] as usize,
            None => 0..0,
        };
        let kept = self.kept[range].iter().find(|(j, _)| *j as usize == second);
        self.second.push(second as u32);
        self.image.push(image);
        self.touching.push(kept.is_some());
        self.memory.push(kept.map_or(Memory::default(), |(_, memory)| *memory));
    }

    fn meet(&mut self, i: usize, bodies: &Bodies) {
        let home = self.grid.place(self.grid.of[i] as usize);
        let (x, reach) = (bodies.x[i], bodies.radius[i] + bodies.skin);
        for k in 0..27 {
            let step = [k % 3, k / 3 % 3, k / 9];
            let Some((cell, image)) = self.grid.beside(home, step, bodies.cell) else { continue };
            let from = x - bodies.cell.image(image);
            for at in self.grid.start[cell]..self.grid.start[cell + 1] {
                let j = self.grid.grains[at as usize] as usize;
                if j <= i || bodies.inverse_mass[i] + bodies.inverse_mass[j] == 0.0 {
                    continue;
                }
                let most = reach + bodies.radius[j];
                if (bodies.x[j] - from).norm_squared() < most * most {
                    self.add(i, j, image);
                }
            }
        }
    }

    fn meet_walls(&mut self, i: usize, bodies: &Bodies) {
        if bodies.inverse_mass[i] == 0.0 {
            return;
        }
        for (k, wall) in bodies.walls.iter().enumerate() {
            if wall.nearest(&bodies.x[i]).0 < bodies.radius[i] + bodies.skin {
                self.add(i, bodies.x.len() + k, [0; 3]);
            }
        }
    }

    /// The pairs by their second grain.
    fn turn_round(&mut self, n: usize) {
        self.incoming_start.clear();
        self.incoming_start.resize(n + 1, 0);
        let grains = |j: &&u32| (**j as usize) < n;
        for j in self.second.iter().filter(grains) {
            self.incoming_start[*j as usize + 1] += 1;
        }
        for k in 0..n {
            self.incoming_start[k + 1] += self.incoming_start[k];
        }
        self.incoming.clear();
        self.incoming.resize(self.incoming_start[n] as usize, 0);
        // Filled from behind, so that every row ends up in order and every end becomes a start.
        for p in (0..self.second.len()).rev() {
            let j = self.second[p] as usize;
            if j < n {
                self.incoming_start[j + 1] -= 1;
                self.incoming[self.incoming_start[j + 1] as usize] = p as u32;
            }
        }
        self.incoming_start.rotate_left(1);
        self.incoming_start[n] = self.incoming.len() as u32;
    }
}

impl Grid {
    fn sort(&mut self, bodies: &Bodies) -> Result<(), Narrow> {
        let widest = 2.0 * bodies.radius.iter().copied().fold(0.0, f64::max) + bodies.skin;
        self.cover(bodies, widest)?;
        let total: usize = self.count.iter().product();
        self.of.clear();
        self.start.clear();
        self.start.resize(total + 1, 0);
        for x in bodies.x {
            let shares = bodies.cell.shares(x);
            let [i, j, k] = [0, 1, 2].map(|k| {
                let at = ((shares[k] - self.low[k]) * self.over[k]) as usize;
                at.min(self.count[k] - 1)
            });
            let cell = (k * self.count[1] + j) * self.count[0] + i;
            self.of.push(cell as u32);
            self.start[cell + 1] += 1;
        }
        for cell in 0..total {
            self.start[cell + 1] += self.start[cell];
        }
        self.grains.resize(bodies.x.len(), 0);
        for i in (0..bodies.x.len()).rev() {
            let cell = self.of[i] as usize;
            self.start[cell + 1] -= 1;
            self.grains[self.start[cell + 1] as usize] = i as u32;
        }
        self.start.rotate_left(1);
        self.start[total] = bodies.x.len() as u32;
        Ok(())
    }

    /// Lays cells over the grains: over the whole cell where it repeats itself.
    fn cover(&mut self, bodies: &Bodies, widest: f64) -> Result<(), Narrow> {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for (x, _) in bodies.x.iter().zip(bodies.gone).filter(|(_, gone)| !**gone) {
            let shares = bodies.cell.shares(x);
            for k in 0..3 {
                (low[k], high[k]) = (low[k].min(shares[k]), high[k].max(shares[k]));
            }
        }
        let widths = bodies.cell.widths();
        for k in 0..3 {
            if bodies.cell.periodic[k] {
                (low[k], high[k]) = (0.0, 1.0);
            }
            self.count[k] = (((high[k] - low[k]) * widths[k] / widest) as usize).max(1);
            if bodies.cell.periodic[k] && self.count[k] < 3 {
                return Err(Narrow);
            }
        }
        while self.count.iter().map(|c| *c as f64).product::<f64>()
            > (CELLS * bodies.x.len() + LEAST) as f64
        {
            let k = (0..3).max_by_key(|k| self.count[*k]).unwrap_or(0);
            self.count[k] = self.count[k].div_ceil(2);
        }
        self.low = low;
        self.over = [0, 1, 2].map(|k| self.count[k] as f64 / (high[k] - low[k]));
        Ok(())
    }

    fn place(&self, cell: usize) -> [usize; 3] {
        let [a, b, _] = self.count;
        [cell % a, cell / a % b, cell / a / b]
    }

    /// The cell one step on (0 back, 1 here, 2 forth), and in which image it lies.
    fn beside(&self, home: [usize; 3], step: [usize; 3], cell: &Cell) -> Option<(usize, [i8; 3])> {
        let (mut at, mut image) = ([0; 3], [0i8; 3]);
        for k in 0..3 {
            let count = self.count[k];
            let there = home[k] + step[k];
            at[k] = match there {
                0 if cell.periodic[k] => {
                    image[k] = -1;
                    count - 1
                }
                there if there > count && cell.periodic[k] => {
                    image[k] = 1;
                    0
                }
                there if there == 0 || there > count => return None,
                there => there - 1,
            };
        }
        Some(((at[2] * self.count[1] + at[1]) * self.count[0] + at[0], image))
    }
}
