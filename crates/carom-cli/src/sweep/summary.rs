//! Means and standard errors over the seeds of a sweep.
use super::table::{COLUMNS, Row, line};
use crate::draft::Draft;
use std::io::{self, Write};

/// The key that rows are gathered over.
const OVER: &str = "run.seed";

/// Rows that differ in their seed alone.
struct Group {
    values: Vec<String>,
    rows: Vec<usize>,
}

/// Writes a row for each combination of everything but the seed, in the order in which they first come: its values, how many
/// runs it has, and the mean and the standard error of each number.
pub fn write(mut to: Draft, keys: &[String], rows: &[Row]) -> io::Result<()> {
    to.write_all(text(keys, rows).as_bytes())?;
    to.complete()
}

fn text(keys: &[String], rows: &[Row]) -> String {
    let kept: Vec<usize> = (0..keys.len()).filter(|&k| keys[k] != OVER).collect();
    let mut places = std::collections::BTreeMap::new();
    let mut groups: Vec<Group> = Vec::new();
    for (k, row) in rows.iter().enumerate() {
        let values: Vec<String> = kept.iter().map(|&k| row.values()[k].clone()).collect();
        let place = *places.entry(values.clone()).or_insert_with(|| {
            groups.push(Group { values, rows: Vec::new() });
            groups.len() - 1
        });
        groups[place].rows.push(k);
    }
    let numbers = || COLUMNS.iter().filter(|c| c.1).map(|c| c.0);
    let mut head: Vec<String> = kept.iter().map(|&k| keys[k].clone()).collect();
    head.push("runs".into());
    head.extend(numbers().flat_map(|name| [format!("{name}_mean"), format!("{name}_error")]));
    let mut text = line(head.iter().map(String::as_str));
    for group in &groups {
        let mut cells = group.values.clone();
        cells.push(group.rows.len().to_string());
        for name in numbers() {
            let all: Vec<f64> = group.rows.iter().map(|&k| rows[k].result(name).parse().unwrap_or(f64::NAN)).collect();
            let (mean, error) = mean(&all);
            cells.push(format!("{mean:?}"));
            cells.push(error.map_or(String::new(), |e| format!("{e:?}")));
        }
        text += &line(cells.iter().map(String::as_str));
    }
    text
}

/// The mean, and its standard error s / sqrt(n) with s^2 = sum (x - mean)^2 / (n - 1); of one number there is none.
fn mean(all: &[f64]) -> (f64, Option<f64>) {
    let n = all.len() as f64;
    let first = all.first().copied().unwrap_or(f64::NAN);
    // About the first, so that equal numbers have exactly that mean.
    let mean = first + all.iter().map(|x| x - first).sum::<f64>() / n;
    let square: f64 = all.iter().map(|x| (x - mean) * (x - mean)).sum();
    (mean, (all.len() > 1).then(|| (square / (n - 1.0) / n).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_and_errors() {
        // 2, 4, 9: mean 5, sum of squares 9 + 1 + 16 = 26, error sqrt(26 / 2 / 3).
        let (m, e) = mean(&[2.0, 4.0, 9.0]);
        assert_eq!((m, e), (5.0, Some((26.0f64 / 6.0).sqrt())));
        assert_eq!(mean(&[0.1; 7]), (0.1, Some(0.0)));
        assert_eq!(mean(&[3.5]), (3.5, None));
        assert!(mean(&[1.0, f64::NAN]).0.is_nan());
    }
}
