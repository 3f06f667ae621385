//! A small check of XML for tests: tags are closed in order, attributes quoted, markup escaped.

/// Panics where `xml` is not well-formed, in the part of XML that drawings and reports use.
pub(crate) fn assert_well_formed(xml: &str) {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = xml.trim();
    assert!(rest.starts_with('<'), "begins with {:?}", rest.get(..20));
    while let Some(at) = rest.find('<') {
        let text = &rest[..at];
        assert!(!text.contains('>'), "stray `>` in {text:?}");
        assert_entities(text);
        let end = rest[at..].find('>').expect("every tag ends") + at;
        let tag = &rest[at + 1..end];
        rest = &rest[end + 1..];
        if tag.starts_with('!') {
            continue;
        }
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name.trim()), "closing tag");
            continue;
        }
        let name = tag.split([' ', '/', '\n']).next().expect("a name");
        let attributes = tag[name.len()..].trim_end_matches('/');
        assert_eq!(attributes.matches('"').count() % 2, 0, "quotes in {tag:?}");
        for (i, part) in attributes.split('"').enumerate() {
            assert_eq!(i % 2 == 0 && !part.trim().is_empty(), part.ends_with('='), "{tag:?}");
            assert_entities(part);
        }
        if !tag.ends_with('/') {
            open.push(name);
        }
    }
    assert!(open.is_empty(), "left open: {open:?}");
    assert!(rest.trim().is_empty(), "ends with {rest:?}");
}

fn assert_entities(text: &str) {
    for part in text.split('&').skip(1) {
        let name = part.split(';').next().expect("a first part");
        assert!(["lt", "gt", "amp", "quot", "apos", "#39"].contains(&name), "entity in {text:?}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn good_xml_passes() {
        assert_well_formed("<a b=\"1 &lt; 2\"><c/>text &amp; more</a>");
    }

    #[test]
    #[should_panic(expected = "closing tag")]
    fn crossed_tags_do_not() {
        assert_well_formed("<a><b></a></b>");
    }

    #[test]
    #[should_panic(expected = "entity")]
    fn bare_ampersands_do_not() {
        assert_well_formed("<a>x & y</a>");
    }
}
