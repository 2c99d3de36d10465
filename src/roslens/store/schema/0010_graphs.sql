-- Which launch files a run looked at for computation graphs, and which it left out.

ALTER TABLE run ADD COLUMN graphs TEXT NOT NULL DEFAULT 'null';     -- JSON object, null where it looked at none
