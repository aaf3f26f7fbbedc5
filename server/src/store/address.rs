//! Addresses of databases.

use reqwest::Url;

/// The address of a database as it may be shown, without a password.
pub fn shown_address(url: &str) -> String {
    let shown = |mut url: Url| {
        // Fails for addresses without host, which have no password.
        let _ = url.set_password(None);
        url.set_query(None);
        url.to_string()
    };
    match url.split_once(':') {
        Some((scheme, _)) if scheme != "sqlite" => {
            Url::parse(url).map_or_else(|_| format!("{scheme}:.."), shown)
        }
        _ => url.to_owned(),
    }
}

/// Returns `true` if an address is that of a PostgreSQL database.
pub(in crate::store) fn is_postgres(url: &str) -> bool {
    let scheme = url.split_once(':').map_or("", |(scheme, _)| scheme);
    scheme.eq_ignore_ascii_case("postgres") || scheme.eq_ignore_ascii_case("postgresql")
}
