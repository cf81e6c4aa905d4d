//! Comma-separated tables with a line of column names: the raw inputs and the gazetteer.

use std::borrow::Cow;

/// The fields of one line. A field in double quotes may hold commas; two double quotes in it
/// stand for one (RFC 4180). A field does not span lines.
pub(super) fn fields(line: &str) -> Result<Vec<Cow<'_, str>>, String> {
    let mut fields = Vec::with_capacity(16);
    let mut rest = line;
    loop {
        let (field, after) = if let Some(quoted) = rest.strip_prefix('"') {
            let end = closing_quote(quoted).ok_or("a quoted field has no closing quote")?;
            (Cow::Owned(quoted[..end].replace("\"\"", "\"")), &quoted[end + 1..])
        } else {
            let end = rest.find(',').unwrap_or(rest.len());
            (Cow::Borrowed(&rest[..end]), &rest[end..])
        };
        fields.push(field);
        match after.strip_prefix(',') {
            Some(next) => rest = next,
            None if after.is_empty() => return Ok(fields),
            None => return Err("text follows a closing quote".into()),
        }
    }
}

fn closing_quote(quoted: &str) -> Option<usize> {
    let bytes = quoted.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        if bytes[at] == b'"' {
            if bytes.get(at + 1) != Some(&b'"') {
                return Some(at);
            }
            at += 1;
        }
        at += 1;
    }
    None
}

/// One line out of fields, quoted where needed.
pub(super) fn line(fields: &[String]) -> String {
    let quoted = fields.iter().map(|field| {
        if field.contains([',', '"']) {
            format!("\"{}\"", field.replace('"', "\"\""))
        } else {
            field.clone()
        }
    });
    quoted.collect::<Vec<_>>().join(",")
}

/// A line number, counted from 1, and the fields of that line.
pub(super) type Row<'a> = (usize, Vec<Cow<'a, str>>);
/// A line number and what is wrong there.
pub(super) type RowError = (usize, String);

/// The rows below the column names.
///
/// The first line must be exactly `columns`; every row must have as many fields.
pub(super) fn rows<'a>(text: &'a str, columns: &str) -> Result<Vec<Row<'a>>, RowError> {
    let mut lines = text.lines().zip(1..);
    if lines.next().map(|(line, _)| line) != Some(columns) {
        return Err((1, format!("the columns are not {columns:?}")));
    }
    let count = columns.split(',').count();
    let mut rows = Vec::new();
    for (line, number) in lines {
        let fields = fields(line).map_err(|what| (number, what))?;
        if fields.len() != count {
            return Err((number, format!("there are {} fields, not {count}", fields.len())));
        }
        rows.push((number, fields));
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotes_hold_commas_and_quotes() {
        let line_in = r#""Washington, D.C.",,"the ""Mall""",6"#;
        let got = fields(line_in).unwrap();
        assert_eq!(got, ["Washington, D.C.", "", "the \"Mall\"", "6"]);
        let owned: Vec<String> = got.into_iter().map(Cow::into_owned).collect();
        assert_eq!(line(&owned), line_in);
        assert_eq!(fields("").unwrap(), [""]);
        assert_eq!(fields("a,").unwrap(), ["a", ""]);
    }

    #[test]
    fn broken_quotes_are_refused() {
        assert!(fields("\"a,b").is_err());
        assert!(fields("\"a\"b").is_err());
        assert!(fields("\"a\"\"").is_err());
    }

    #[test]
    fn rows_have_the_columns_they_claim() {
        assert_eq!(rows("a,b\n1,2\n", "a,b").unwrap(), [(2, vec!["1".into(), "2".into()])]);
        assert_eq!(rows("a,c\n1,2\n", "a,b").unwrap_err().0, 1);
        assert_eq!(rows("a,b\n1,2\n1\n", "a,b").unwrap_err().0, 3);
    }
}
