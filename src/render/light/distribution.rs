//! A distribution over the cells of a grid.

/// Draws cells of a grid in proportion to their weights, row first; in double precision.
pub struct GridDistribution {
    width: usize,
    /// The cumulative weights of the rows, from 0 to 1.
    rows: Vec<f64>,
    /// The cumulative weights within each row, from 0 to 1, one row after the other.
    columns: Vec<f64>,
}

/// A cell, the place within it in [0, 1)², and its probability.
pub struct GridSample {
    pub column: usize,
    pub row: usize,
    pub x: f64,
    pub y: f64,
    pub pmf: f64,
}

impl GridDistribution {
    /// A distribution over `weights`, `height × width`, none negative; `None` when all are 0.
    pub fn new(width: usize, weights: &[f64]) -> Option<Self> {
        let totals: Vec<f64> = weights.chunks(width).map(|row| row.iter().sum()).collect();
        let rows = cumulative(&totals)?;
        let columns = weights
            .chunks(width)
            .flat_map(|row| cumulative(row).unwrap_or_else(|| vec![0.0; width + 1]))
            .collect();
        Some(Self { width, rows, columns })
    }

    /// Draws a cell by `(ux, uy)` in [0, 1)².
    pub fn sample(&self, ux: f64, uy: f64) -> GridSample {
        let (row, y) = find(&self.rows, uy);
        let (column, x) = find(self.columns_of(row), ux);
        GridSample { column, row, x, y, pmf: self.pmf(column, row) }
    }

    /// The probability of a cell.
    pub fn pmf(&self, column: usize, row: usize) -> f64 {
        let columns = self.columns_of(row);
        (self.rows[row + 1] - self.rows[row]) * (columns[column + 1] - columns[column])
    }

    fn columns_of(&self, row: usize) -> &[f64] {
        &self.columns[row * (self.width + 1)..][..=self.width]
    }
}

/// Partial sums divided by the total, from 0 to exactly 1; `None` when the total is 0.
fn cumulative(weights: &[f64]) -> Option<Vec<f64>> {
    let total: f64 = weights.iter().sum();
    let mut sum = 0.0;
    let mut sums = vec![0.0];
    sums.extend(weights.iter().map(|weight| {
        sum += weight;
        sum / total
    }));
    sums[weights.len()] = 1.0;
    // Cells of no weight behind the last of some weight must keep no width, now that the end is 1.
    let last = weights.iter().rposition(|&weight| weight > 0.0)?;
    sums[last + 1..].fill(1.0);
    Some(sums)
}

/// The cell of non-zero width that holds `u`, and how far into it `u` lies.
fn find(sums: &[f64], u: f64) -> (usize, f64) {
    let cell = sums.partition_point(|&sum| sum <= u) - 1;
    let width = sums[cell + 1] - sums[cell];
    (cell, (u - sums[cell]) / width)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_draw_lands_in_a_cell_of_no_weight() {
        let weights = [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0];
        let grid = GridDistribution::new(3, &weights).expect("some weight");
        let edges = [0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0 - f64::from(f32::EPSILON) / 2.0];
        for ux in edges {
            for uy in edges {
                let cell = grid.sample(ux, uy);
                assert!(weights[cell.row * 3 + cell.column] > 0.0);
                assert!(cell.pmf > 0.0 && (0.0..1.0).contains(&cell.x) && (0.0..1.0).contains(&cell.y));
            }
        }
        assert!(GridDistribution::new(2, &[0.0; 4]).is_none());
    }
}
