-- How a whole system stood at an instant, from which later ones follow by the verdicts that changed since.

CREATE TABLE moment (
    time REAL PRIMARY KEY,            -- seconds since the epoch
    content BLOB NOT NULL             -- MessagePack, deflated: see store/past/moment.py
) WITHOUT ROWID;

-- Marks of a stretch of time are counted without reading a verdict.
CREATE INDEX verdict_mark ON verdict (time, state, entity);
