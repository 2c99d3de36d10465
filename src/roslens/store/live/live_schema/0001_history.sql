-- What a live system did. A point is what one series was over one bucket of its tier; an older bucket is found in a
-- coarser tier only. Verdicts and events are kept as they changed.

CREATE TABLE series (
    id INTEGER PRIMARY KEY,
    entity TEXT NOT NULL,             -- text form of an entity id
    quantity TEXT NOT NULL,           -- key of a signal
    UNIQUE (entity, quantity)
);

CREATE TABLE point (
    series INTEGER NOT NULL REFERENCES series ON DELETE CASCADE,
    tier INTEGER NOT NULL,            -- seconds a bucket is long
    bucket INTEGER NOT NULL,          -- seconds since the epoch at which it begins, a multiple of the tier
    count INTEGER NOT NULL,
    mean REAL NOT NULL,
    least REAL NOT NULL,
    greatest REAL NOT NULL,
    PRIMARY KEY (series, tier, bucket)
) WITHOUT ROWID;
CREATE INDEX point_age ON point (tier, bucket);

CREATE TABLE verdict (
    id INTEGER PRIMARY KEY,
    time REAL NOT NULL,
    entity TEXT NOT NULL,
    state TEXT NOT NULL,
    content TEXT NOT NULL             -- the verdict, JSON
);
CREATE INDEX verdict_time ON verdict (time);
CREATE INDEX verdict_entity ON verdict (entity, time);

CREATE TABLE event (
    id INTEGER PRIMARY KEY,
    time REAL NOT NULL,
    entity TEXT NOT NULL,
    change TEXT NOT NULL,
    detail TEXT NOT NULL
);
CREATE INDEX event_time ON event (time);
