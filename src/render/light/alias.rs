//! Discrete choice in constant time.

/// A table that draws indices in proportion to given weights (Walker 1977; Vose 1991 builds it in linear time).
///
/// Built in double precision: weights that differ by a factor of 10¹² each keep their own share.
pub struct AliasTable {
    bins: Vec<Bin>,
}

/// One bin of equal probability: with probability `keep` its own index, else `alias`.
struct Bin {
    keep: f64,
    alias: u32,
    pmf: f64,
}

impl AliasTable {
    /// A table over weights; those that are not positive and finite are never drawn.
    pub fn new(weights: &[f64]) -> Self {
        let weight = |w: f64| if w > 0.0 && w.is_finite() { w } else { 0.0 };
        let total: f64 = weights.iter().map(|&w| weight(w)).sum();
        if total <= 0.0 {
            return Self { bins: Vec::new() };
        }
        let mut bins: Vec<Bin> =
            (0..).zip(weights).map(|(i, &w)| Bin { keep: 1.0, alias: i, pmf: weight(w) / total }).collect();

        // Fill each bin that is not full from one that is too full, until none is left of either.
        let mut heights: Vec<f64> = bins.iter().map(|bin| bin.pmf * weights.len() as f64).collect();
        let (mut low, mut high): (Vec<usize>, Vec<usize>) = (0..bins.len()).partition(|&i| heights[i] < 1.0);
        while let (Some(&giver), Some(taker)) = (high.last(), low.pop()) {
            bins[taker].keep = heights[taker];
            bins[taker].alias = giver as u32;
            heights[giver] -= 1.0 - heights[taker];
            if heights[giver] < 1.0 {
                high.pop();
                low.push(giver);
            }
        }
        // What rounding leaves over is full, unless it can never be drawn.
        let heaviest = (0..bins.len()).max_by(|&a, &b| bins[a].pmf.total_cmp(&bins[b].pmf)).unwrap_or(0);
        for i in low {
            if bins[i].pmf == 0.0 {
                bins[i].keep = 0.0;
                bins[i].alias = heaviest as u32;
            }
        }
        Self { bins }
    }

    /// An index with its probability, by `u` in [0, 1); `None` when every weight was 0.
    pub fn sample(&self, u: f32) -> Option<(usize, f32)> {
        let scaled = f64::from(u) * self.bins.len() as f64;
        let bin = self.bins.get(scaled as usize)?;
        let index = if scaled.fract() < bin.keep { scaled as usize } else { bin.alias as usize };
        Some((index, self.pmf(index)))
    }

    /// The probability of an index.
    pub fn pmf(&self, index: usize) -> f32 {
        self.bins.get(index).map_or(0.0, |bin| bin.pmf as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequencies_follow_the_weights_and_nothing_of_weight_zero_is_drawn() {
        let weights = [3.0, 0.0, 1e-3, 5.0, f64::INFINITY, 0.25, -1.0];
        let table = AliasTable::new(&weights);
        let n = 1 << 20;
        let mut counts = [0_u32; 7];
        for i in 0..n {
            let (index, pmf) = table.sample(i as f32 / n as f32).expect("weights are positive");
            assert!(pmf > 0.0);
            counts[index] += 1;
        }
        for (count, weight) in counts.iter().zip([3.0, 0.0, 1e-3, 5.0, 0.0, 0.25, 0.0]) {
            let expected = weight / 8.251 * f64::from(n);
            assert!((f64::from(*count) - expected).abs() <= 8.0, "{count} of {expected}");
        }
    }

    #[test]
    fn a_weak_light_among_strong_ones_keeps_its_share() {
        let mut weights = vec![1.0; 1_000];
        weights[17] = 1e-12;
        let pmf = f64::from(AliasTable::new(&weights).pmf(17));
        assert!((pmf / (1e-12 / 999.0) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn no_weight_no_choice() {
        assert_eq!(AliasTable::new(&[0.0, 0.0]).sample(0.5), None);
        assert_eq!(AliasTable::new(&[]).sample(0.5), None);
    }
}
