//! Rows that share their work.

/// Rows by what they have in common, in the order in which it first appears.
pub fn grouped<T: Copy, K: PartialEq>(rows: &[T], key: impl Fn(&T) -> K) -> Vec<Vec<T>> {
    let mut groups: Vec<(K, Vec<T>)> = Vec::new();
    // Rows that belong together mostly stand together.
    let mut last = 0;
    for row in rows {
        let of_row = key(row);
        let found = match groups.get(last) {
            Some((key, _)) if *key == of_row => Some(last),
            _ => groups.iter().position(|(key, _)| *key == of_row),
        };
        last = found.unwrap_or(groups.len());
        match groups.get_mut(last) {
            Some((_, group)) => group.push(*row),
            None => groups.push((of_row, vec![*row])),
        }
    }
    groups.into_iter().map(|(_, group)| group).collect()
}

/// The different numbers among some, ascending.
pub fn distinct(numbers: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut all: Vec<f64> = numbers.collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_grouped_in_order() {
        let groups = grouped(&[3, 13, 4, 23, 24, 14, 5], |row| row % 10);
        assert_eq!(groups, [vec![3, 13, 23], vec![4, 24, 14], vec![5]]);
        assert!(grouped(&[0; 0], |row| *row).is_empty());
        assert_eq!(distinct([2.0, 1.0, 2.0].into_iter()), [1.0, 2.0]);
    }
}
