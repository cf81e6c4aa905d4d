//! Rows and fields of a CSV text: commas, optional double quotes, a doubled quote inside quotes.

use super::GazetteerError;

/// The rows that carry something, with their line numbers from 1. A row is one line.
pub(super) fn rows(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let numbered = (1..).zip(text.lines().map(|line| line.trim_end_matches('\r')));
    numbered.filter(|(_, row)| !row.trim().is_empty() && !row.starts_with('#'))
}

/// The fields of a row, without their quotes.
pub(super) fn fields(line: usize, row: &str) -> Result<Vec<String>, GazetteerError> {
    if !row.contains('"') {
        return Ok(row.split(',').map(str::to_string).collect());
    }
    let mut fields = vec![String::new()];
    let mut is_quoted = false;
    let mut characters = row.chars().peekable();
    while let Some(c) = characters.next() {
        let is_doubled = is_quoted && c == '"' && characters.next_if_eq(&'"').is_some();
        match (c, fields.last_mut()) {
            ('"', Some(field)) if is_doubled => field.push('"'),
            ('"', _) => is_quoted = !is_quoted,
            (',', _) if !is_quoted => fields.push(String::new()),
            (c, Some(field)) => field.push(c),
            (_, None) => {}
        }
    }
    if is_quoted { Err(GazetteerError::Quote { line }) } else { Ok(fields) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotes_keep_commas_and_quotes() {
        let row = r#""Washington (Washington, D.C.)",x,"say ""hi""",,7"#;
        let expected = ["Washington (Washington, D.C.)", "x", "say \"hi\"", "", "7"];
        assert_eq!(fields(1, row).unwrap(), expected);
        assert_eq!(fields(3, r#"a,"b"#), Err(GazetteerError::Quote { line: 3 }));
    }

    #[test]
    fn comments_and_empty_lines_are_counted_and_passed_over() {
        let text = "\u{feff}# head\r\n\r\na,b\r\n  \nc";
        assert_eq!(rows(text).collect::<Vec<_>>(), [(3, "a,b"), (5, "c")]);
    }
}
