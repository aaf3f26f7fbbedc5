//! Both engines have the same tables with the same columns.

use std::collections::BTreeSet;

use sqlx::{Connection, PgConnection, SqliteConnection};

use super::*;

/// Tables that one engine alone needs: which process serves a file and by which clock, and how many jobs it has.
const OF_SQLITE: [&str; 3] = ["owner", "clock", "job_counts"];

#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn both_engines_have_the_same_columns() {
    let (file, server) = (Place::sqlite(), Place::postgres());
    for place in [&file, &server] {
        let store = Store::open_with(&place.url, &place.files(), Limits::default()).await;
        store.expect("a store").close().await;
    }
    let mut database = SqliteConnection::connect(&file.url).await.expect("a file");
    let of_file: Vec<(String, String, bool)> = sqlx::query_as(
        "SELECT tables.name, columns.name, columns.\"notnull\" <> 0 FROM sqlite_master AS tables, pragma_table_info(tables.name) AS columns \
         WHERE tables.type = 'table' AND tables.name NOT LIKE '\\_sqlx%' ESCAPE '\\' AND tables.name NOT LIKE 'sqlite%'",
    )
    .fetch_all(&mut database)
    .await
    .expect("its columns");
    let mut database = PgConnection::connect(&server.url).await.expect("a server");
    let of_server: Vec<(String, String, bool)> = sqlx::query_as(
        "SELECT table_name::text, column_name::text, is_nullable = 'NO' FROM information_schema.columns \
         WHERE table_schema = 'public' AND table_name NOT LIKE '\\_sqlx%'",
    )
    .fetch_all(&mut database)
    .await
    .expect("its columns");
    let of_file = of_file.into_iter();
    let shared = of_file.filter(|(table, ..)| !OF_SQLITE.contains(&table.as_str()));
    let (shared, of_server): (BTreeSet<_>, BTreeSet<_>) =
        (shared.collect(), of_server.into_iter().collect());
    let missing: Vec<_> = shared.difference(&of_server).collect();
    assert!(missing.is_empty(), "not in PostgreSQL: {missing:?}");
    let more: Vec<_> = of_server.difference(&shared).collect();
    let column =
        |table: &str, name: &str, is_needed| (table.to_owned(), name.to_owned(), is_needed);
    // Files of services that share no folder, and a lock of the process that removes objects.
    let of_several = [
        column("result_files", "object", false),
        column("unnamed_objects", "content", false),
        column("unnamed_objects", "is_removing", true),
    ];
    assert_eq!(more, of_several.iter().collect::<Vec<_>>());
}
