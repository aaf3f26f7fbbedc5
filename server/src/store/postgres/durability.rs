//! Settings of a server with which it can lose what it has acknowledged. They belong to its administrator, who is warned.

use sqlx::Row;
use sqlx::postgres::PgConnection;

/// Settings and standbys of a server.
#[derive(Debug, Clone, Copy)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "settings of a server are independent of each other"
)]
struct Durability {
    /// True if it waits for its disk.
    fsync: bool,
    /// True if it can repair pages that were half written.
    full_page_writes: bool,
    /// True if a commit waits for its own disk.
    is_commit_awaited: bool,
    /// True if a commit waits for a standby.
    is_standby_awaited: bool,
    /// True if it has standbys.
    has_standbys: bool,
}

/// Warns of settings with which the server at `connection` can lose acknowledged writes.
pub(super) async fn warn(connection: &mut PgConnection) {
    let risks = match durability(connection).await {
        Ok(found) => found.risks(),
        // A service also starts with a role that may not read the settings.
        Err(error) => return tracing::debug!(%error, "settings of the database are unknown"),
    };
    for risk in risks {
        tracing::warn!("the database can lose what it has acknowledged: {risk}");
    }
}

async fn durability(connection: &mut PgConnection) -> Result<Durability, sqlx::Error> {
    let row = sqlx::query(
        "SELECT current_setting('fsync') = 'on', current_setting('full_page_writes') = 'on', \
             current_setting('synchronous_commit') <> 'off', \
             current_setting('synchronous_commit') NOT IN ('off', 'local') \
                 AND current_setting('synchronous_standby_names') <> '', \
             EXISTS (SELECT FROM pg_stat_replication WHERE application_name NOT IN ('pg_basebackup', 'pg_receivewal'))",
    )
    .fetch_one(connection)
    .await?;
    Ok(Durability {
        fsync: row.try_get(0)?,
        full_page_writes: row.try_get(1)?,
        is_commit_awaited: row.try_get(2)?,
        is_standby_awaited: row.try_get(3)?,
        has_standbys: row.try_get(4)?,
    })
}

impl Durability {
    /// Risks of data loss, with their causes.
    fn risks(self) -> Vec<&'static str> {
        let risks = [
            (
                !self.fsync,
                "fsync is off: a crash of its machine can damage all of it",
            ),
            (
                !self.full_page_writes,
                "full_page_writes is off: a crash of its machine can damage pages",
            ),
            (
                !self.is_commit_awaited,
                "synchronous_commit is off: a crash of the server loses the last commits",
            ),
            (
                self.has_standbys && !self.is_standby_awaited,
                "it has standbys, of which none confirms commits (synchronous_standby_names): a failover loses the last ones",
            ),
        ];
        let has_risk = |(is_there, risk)| bool::then_some(is_there, risk);
        risks.into_iter().filter_map(has_risk).collect()
    }
}

#[cfg(test)]
mod tests {
    use sqlx::Connection;

    use super::*;
    use crate::store::tests::Place;

    /// A server that loses nothing.
    const DURABLE: Durability = Durability {
        fsync: true,
        full_page_writes: true,
        is_commit_awaited: true,
        is_standby_awaited: true,
        has_standbys: true,
    };

    #[test]
    fn every_setting_that_can_lose_commits_is_named() {
        assert_eq!(DURABLE.risks(), [""; 0]);
        let named = |changed: Durability, name: &str| {
            let risks = changed.risks();
            assert!(
                matches!(risks[..], [one] if one.contains(name)),
                "{risks:?}"
            );
        };
        named(
            Durability {
                fsync: false,
                ..DURABLE
            },
            "fsync is off",
        );
        named(
            Durability {
                full_page_writes: false,
                ..DURABLE
            },
            "full_page_writes is off",
        );
        named(
            Durability {
                is_commit_awaited: false,
                ..DURABLE
            },
            "synchronous_commit is off",
        );
        let alone = Durability {
            is_standby_awaited: false,
            ..DURABLE
        };
        named(alone, "synchronous_standby_names");
        let alone = Durability {
            has_standbys: false,
            ..alone
        };
        assert_eq!(alone.risks(), [""; 0], "one server needs no standby");
    }

    #[tokio::test]
    #[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
    async fn settings_are_those_of_the_server() {
        let place = Place::postgres();
        let mut connection = PgConnection::connect(&place.url).await.expect("a server");
        let found = durability(&mut connection).await.expect("settings");
        assert!(found.is_commit_awaited && !found.has_standbys, "{found:?}");
        sqlx::query("SET synchronous_commit = off")
            .execute(&mut connection)
            .await
            .expect("set");
        let found = durability(&mut connection).await.expect("settings");
        assert!(!found.is_commit_awaited, "{found:?}");
    }
}
