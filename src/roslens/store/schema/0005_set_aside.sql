-- Findings that count nowhere because a comment, the configuration or the file of accepted findings says so.

CREATE TABLE set_aside (
    unit INTEGER NOT NULL REFERENCES unit ON DELETE CASCADE,
    position INTEGER NOT NULL,
    path TEXT NOT NULL,
    state TEXT NOT NULL,              -- suppressed, ignored, accepted or false_positive
    reason TEXT NOT NULL,
    said_by TEXT NOT NULL,            -- place of a comment, "[[ignore]] 2", or a fingerprint
    package TEXT NOT NULL,
    finding TEXT NOT NULL,            -- JSON
    PRIMARY KEY (unit, position)
) WITHOUT ROWID;
CREATE INDEX set_aside_path ON set_aside (path);
