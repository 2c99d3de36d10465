-- What the history of repositories says (process metrics), each once however many runs share it; and which past
-- revisions runs are of, in a store that holds the history of a repository.

CREATE TABLE process (
    id INTEGER PRIMARY KEY,
    digest TEXT NOT NULL UNIQUE,
    content BLOB NOT NULL             -- JSON, compressed by zlib
);

CREATE TABLE run_process (
    run INTEGER NOT NULL REFERENCES run ON DELETE CASCADE,
    position INTEGER NOT NULL,
    process INTEGER NOT NULL REFERENCES process,
    PRIMARY KEY (run, position)
) WITHOUT ROWID;
CREATE INDEX run_process_process ON run_process (process);

CREATE TABLE revision (
    run INTEGER PRIMARY KEY REFERENCES run ON DELETE CASCADE,
    "commit" TEXT NOT NULL,
    key TEXT NOT NULL,                -- of everything besides files that shaped the run
    time_s INTEGER NOT NULL           -- when it was committed, in seconds since 1970
);
CREATE INDEX revision_commit ON revision ("commit", key);
