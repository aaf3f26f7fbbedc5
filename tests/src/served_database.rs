//! Which database the services of a folder serve.

use std::path::Path;

use crate::postgres::PostgresServer;

/// File with the address of the database of a folder.
const ADDRESS: &str = "database-url";
/// Lets every case use PostgreSQL. Those about the file of a database, its disk and its clock then fail.
const EVERYWHERE: &str = "FRETWEAR_TEST_POSTGRESQL";

/// Lets the services of a folder serve a database of the PostgreSQL server that the cases share.
///
/// # Panics
/// If the folder cannot be written.
pub fn use_postgresql(folder: &Path) -> String {
    let url = PostgresServer::shared().new_database();
    use_database(folder, &url);
    url
}

/// Lets the services of a folder serve a database.
///
/// # Panics
/// If the folder cannot be written.
pub fn use_database(folder: &Path, url: &str) {
    std::fs::write(folder.join(ADDRESS), url).expect("a file");
}

/// Address of the database of a folder.
pub fn address_of_database(folder: &Path) -> String {
    match std::fs::read_to_string(folder.join(ADDRESS)) {
        Ok(url) => url,
        Err(_) if std::env::var_os(EVERYWHERE).is_some() => use_postgresql(folder),
        Err(_) => format!("sqlite://{}", folder.join("fretwear.db").display()),
    }
}
