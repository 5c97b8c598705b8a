//! Places for balls that do not overlap: thrown at random into a periodic box and pushed apart until none do. Well below random
//! close packing (0.64 for spheres, 0.84 for discs) that takes some hundred sweeps, and the result is a liquid, not a crystal
//! that would have to melt.
use crate::dice::Dice;

/// Most sweeps there are: far more than any workload takes.
const SWEEPS: usize = 20_000;
/// What is left between balls at least, over the sum of the radii.
const CLEAR: f64 = 1e-7;

/// Places in a periodic box of this side, one for each radius; `None` if they do not come free of each other.
pub(crate) fn pack<const D: usize>(radii: &[f64], side: f64, dice: &mut Dice) -> Option<Vec<[f64; D]>> {
    let largest = radii.iter().fold(0.0, |m: f64, &r| m.max(r));
    let cells = ((side / (2.0 * largest * 1.02)) as usize).max(1);
    let mut places: Vec<[f64; D]> = radii.iter().map(|_| std::array::from_fn(|_| dice.unit() * side)).collect();
    // A little more than is needed, less each time, so that pairs come free quickly at first.
    let mut more = 0.02;
    for _ in 0..SWEEPS {
        // A push may bring a ball close to one that was looked at before: free is only what a sweep without pushes finds free.
        if sweep(&mut places, radii, side, cells, Some(more)) && sweep(&mut places, radii, side, cells, None) {
            return Some(places);
        }
        more = (more * 0.98).max(4.0 * CLEAR);
    }
    None
}

/// True if all balls are free of each other. Pairs that are not farther apart than the sum of the radii and this part `more` of it
/// are pushed apart to there; with `None` nothing moves.
fn sweep<const D: usize>(places: &mut [[f64; D]], radii: &[f64], side: f64, cells: usize, more: Option<f64>) -> bool {
    let mut free = true;
    let grid = Grid::<D>::new(places, side, cells);
    for i in 0..places.len() {
        let x = places[i];
        grid.around(&x, |j| {
            if j <= i {
                return;
            }
            let (a, b) = (places[i], places[j]);
            let mut d: [f64; D] = std::array::from_fn(|k| b[k] - a[k]);
            for x in &mut d {
                // The nearest image: places lie in the box.
                *x = if *x > 0.5 * side {
                    *x - side
                } else if *x < -0.5 * side {
                    *x + side
                } else {
                    *x
                };
            }
            let square = d.iter().map(|x| x * x).sum::<f64>();
            let reach = radii[i] + radii[j];
            let wanted = reach * (1.0 + more.unwrap_or(CLEAR));
            if !(square < wanted * wanted) {
                return;
            }
            let distance = square.sqrt();
            free &= distance > reach * (1.0 + CLEAR);
            if more.is_some() {
                // Each goes half the way along the line of centres.
                let step = 0.5 * (wanted * (1.0 + CLEAR) - distance) / distance.max(1e-12);
                for k in 0..D {
                    places[i][k] = wrap(a[k] - d[k] * step, side);
                    places[j][k] = wrap(b[k] + d[k] * step, side);
                }
            }
        });
    }
    free
}

fn wrap(x: f64, side: f64) -> f64 {
    let x = x - (x / side).floor() * side;
    if x < side { x } else { 0.0 }
}

/// Cells of a periodic box, each with the balls in it.
struct Grid<const D: usize> {
    cells: usize,
    per: f64,
    start: Vec<u32>,
    balls: Vec<u32>,
}

impl<const D: usize> Grid<D> {
    fn new(places: &[[f64; D]], side: f64, cells: usize) -> Self {
        let per = cells as f64 / side;
        let mut grid = Self { cells, per, start: vec![0; cells.pow(D as u32) + 1], balls: vec![0; places.len()] };
        for x in places {
            let c = grid.cell(x);
            grid.start[c] += 1;
        }
        let mut total = 0;
        for s in &mut grid.start {
            total += *s;
            *s = total;
        }
        for (i, x) in places.iter().enumerate() {
            let c = grid.cell(x);
            grid.start[c] -= 1;
            grid.balls[grid.start[c] as usize] = i as u32;
        }
        grid
    }

    fn axes(&self, x: &[f64; D]) -> [usize; D] {
        std::array::from_fn(|k| ((x[k] * self.per) as usize).min(self.cells - 1))
    }

    fn cell(&self, x: &[f64; D]) -> usize {
        self.axes(x).iter().rev().fold(0, |c, &a| c * self.cells + a)
    }

    /// Every ball in this cell and the ones around it; in a box of fewer than three cells along an axis, once all the same.
    fn around(&self, x: &[f64; D], mut visit: impl FnMut(usize)) {
        let axes = self.axes(x);
        let width = self.cells.min(3);
        for code in 0..width.pow(D as u32) {
            let mut rest = code;
            let mut c = 0;
            for &a in axes.iter().rev() {
                c = c * self.cells + (a + self.cells + rest % width - usize::from(self.cells > 2)) % self.cells;
                rest /= width;
            }
            for k in self.start[c]..self.start[c + 1] {
                visit(self.balls[k as usize] as usize);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// No two overlap, in any image of the box.
    #[test]
    fn nobody_overlaps() {
        let radii: Vec<f64> = (0..200).map(|i| 0.5 * (1.0 + 0.4 * (i % 7) as f64 / 6.0)).collect();
        let filled: f64 = radii.iter().map(|r| std::f64::consts::PI * r * r).sum();
        let side = (filled / 0.70).sqrt();
        let places = pack::<2>(&radii, side, &mut Dice::new(1)).unwrap();
        for i in 0..radii.len() {
            for j in 0..i {
                let square: f64 = (0..2)
                    .map(|k| {
                        let d = places[i][k] - places[j][k];
                        (d - (d / side).round() * side).powi(2)
                    })
                    .sum();
                assert!(square.sqrt() > radii[i] + radii[j], "{i} {j}");
            }
        }
        assert!(pack::<2>(&[0.5; 4], 1.6, &mut Dice::new(1)).is_none(), "four discs in a box for two and a half");
    }
}
