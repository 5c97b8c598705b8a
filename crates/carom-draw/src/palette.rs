//! The 255 colours of a film, chosen once by cutting the box of all its colours (P. Heckbert, 1982, "Color image quantization
//! for frame buffer display"), so that what does not move does not flicker.
use std::collections::BTreeMap;

/// The number that stands for "as it was".
pub const SAME: u8 = 255;
/// Colours in a palette.
const MOST: usize = 255;

/// Some colours, and for every colour the number of the nearest of them.
pub struct Palette {
    colours: Vec<[u8; 3]>,
    /// Six bits a channel; `NONE` where nobody asked yet.
    nearest: Vec<u16>,
}

const NONE: u16 = u16::MAX;

/// How often the eye counts a channel: luma weights, coarsely.
const WEIGHT: [i32; 3] = [3, 6, 1];

/// Counts colours.
#[derive(Default)]
pub struct Census {
    count: BTreeMap<[u8; 3], u64>,
}

impl Census {
    /// Counts the colours of pixels (four bytes each).
    pub fn count(&mut self, pixels: &[u8]) {
        let mut run: Option<([u8; 3], u64)> = None;
        for pixel in pixels.chunks_exact(4) {
            let colour = [pixel[0], pixel[1], pixel[2]];
            match &mut run {
                Some((last, n)) if *last == colour => *n += 1,
                _ => {
                    if let Some((last, n)) = run.take() {
                        *self.count.entry(last).or_default() += n;
                    }
                    run = Some((colour, 1));
                }
            }
        }
        if let Some((last, n)) = run {
            *self.count.entry(last).or_default() += n;
        }
    }

    /// The palette of what was counted.
    pub fn palette(&self) -> Palette {
        let mut all: Vec<([u8; 3], f64)> = self.count.iter().map(|(c, n)| (*c, *n as f64)).collect();
        if all.len() <= MOST {
            all.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
            return Palette::new(all.into_iter().map(|c| c.0).collect());
        }
        // What fills much of the picture keeps its very colour: paper, floor, the flats of discs.
        let total: f64 = all.iter().map(|c| c.1).sum();
        let mut order: Vec<&([u8; 3], f64)> = all.iter().filter(|c| c.1 > 0.0004 * total).collect();
        order.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        let mut colours: Vec<[u8; 3]> = order.iter().take(MOST / 3).map(|c| c.0).collect();
        // The rest counts by the square root of its number: edges are thin and yet seen.
        let rest = all.iter().filter(|c| !colours.contains(&c.0)).map(|(c, n)| (*c, n.sqrt())).collect();
        let cut = cut(rest, MOST - colours.len());
        colours.extend(cut);
        Palette::new(colours)
    }
}

fn cut(colours: Vec<([u8; 3], f64)>, most: usize) -> Vec<[u8; 3]> {
    /// A box: its colours, the widest channel, and how much it is worth cutting.
    type Part = (Vec<([u8; 3], f64)>, usize, f64);
    let measure = |colours: Vec<([u8; 3], f64)>| -> Part {
        let spread = |k: usize| {
            let total: f64 = colours.iter().map(|c| c.1).sum();
            let mean = colours.iter().map(|c| f64::from(c.0[k]) * c.1).sum::<f64>() / total;
            let square = |c: &([u8; 3], f64)| (f64::from(c.0[k]) - mean) * (f64::from(c.0[k]) - mean) * c.1;
            f64::from(WEIGHT[k]) * colours.iter().map(square).sum::<f64>()
        };
        let spreads = [spread(0), spread(1), spread(2)];
        let widest = (0..3).fold(0, |best, k| if spreads[k] > spreads[best] { k } else { best });
        (colours, widest, spreads[widest])
    };
    if colours.is_empty() {
        return Vec::new();
    }
    let mut parts = vec![measure(colours)];
    while parts.len() < most {
        let best = (0..parts.len()).fold(0, |best, k| if parts[k].2 > parts[best].2 { k } else { best });
        if !(parts[best].2 > 0.0) {
            break;
        }
        let (mut colours, k, _) = parts.swap_remove(best);
        colours.sort_by_key(|c| (c.0[k], c.0));
        let half: f64 = 0.5 * colours.iter().map(|c| c.1).sum::<f64>();
        let mut sum = 0.0;
        let at = colours.iter().position(|c| {
            sum += c.1;
            sum >= half
        });
        let right = colours.split_off(at.map_or(1, |at| at + 1).clamp(1, colours.len() - 1));
        parts.push(measure(colours));
        parts.push(measure(right));
    }
    let mean = |part: &Part| {
        let total: f64 = part.0.iter().map(|c| c.1).sum();
        std::array::from_fn(|k| (part.0.iter().map(|c| f64::from(c.0[k]) * c.1).sum::<f64>() / total + 0.5) as u8)
    };
    parts.iter().map(mean).collect()
}

/// The cell of a colour: six bits a channel.
fn cell(rgb: [u8; 3]) -> usize {
    let [r, g, b] = rgb.map(|c| usize::from(c >> 2));
    r << 12 | g << 6 | b
}

impl Palette {
    fn new(mut colours: Vec<[u8; 3]>) -> Self {
        let mut nearest = vec![NONE; 1 << 18];
        // The first are the most frequent: what is near to one of them is shown as it.
        let first = colours.clone();
        colours.sort_unstable();
        colours.dedup();
        for colour in first {
            let number = colours.binary_search(&colour).unwrap_or(0);
            let cell = &mut nearest[cell(colour)];
            if *cell == NONE {
                *cell = number as u16;
            }
        }
        Self { colours, nearest }
    }

    /// Red, green and blue of every colour, 256 of them; the last is [`SAME`].
    pub fn bytes(&self) -> Vec<u8> {
        let mut all: Vec<u8> = self.colours.iter().flatten().copied().collect();
        all.resize(3 * 256, 0);
        all
    }

    /// The number of the nearest colour.
    pub fn number(&mut self, rgb: [u8; 3]) -> u8 {
        let cell = cell(rgb);
        let known = self.nearest[cell];
        if known != NONE {
            return known as u8;
        }
        // To the middle of the cell: it does not matter which of its colours came first.
        let middle = rgb.map(|c| i32::from(c & !3) + 2);
        let far = |c: &[u8; 3]| -> i32 {
            let square = |k: usize| WEIGHT[k] * (i32::from(c[k]) - middle[k]) * (i32::from(c[k]) - middle[k]);
            square(0) + square(1) + square(2)
        };
        let best = (0..self.colours.len()).min_by_key(|k| far(&self.colours[*k])).unwrap_or(0);
        self.nearest[cell] = best as u16;
        best as u8
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_are_kept_and_many_are_near() {
        let pixels =
            |colours: &[[u8; 3]]| -> Vec<u8> { colours.iter().flat_map(|c| [c[0], c[1], c[2], 255]).collect() };
        let few: Vec<[u8; 3]> = (0..50).map(|k| [5 * k, 255 - 5 * k, 4 * k]).collect();
        let mut census = Census::default();
        census.count(&pixels(&few));
        let mut palette = census.palette();
        for c in &few {
            let k = usize::from(palette.number(*c));
            assert_eq!(&palette.bytes()[3 * k..3 * k + 3], c);
        }
        // A cube of 4096 colours in 255: each is within a step and a half of its grid in every channel.
        let many: Vec<[u8; 3]> = (0..4096u32).map(|k| [k >> 8, k >> 4 & 15, k & 15].map(|c| (17 * c) as u8)).collect();
        let mut census = Census::default();
        census.count(&pixels(&many));
        let mut palette = census.palette();
        let bytes = palette.bytes();
        for c in &many {
            let k = usize::from(palette.number(*c));
            let near = &bytes[3 * k..3 * k + 3];
            let far: i32 = (0..2).map(|k| (i32::from(c[k]) - i32::from(near[k])).abs()).max().unwrap();
            assert!(far <= 40, "{c:?} {near:?}");
        }
    }
}
