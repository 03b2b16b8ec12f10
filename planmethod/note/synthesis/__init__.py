"""A synthesis on paper (синтез на бумаге): its text, drawing, problem file, verification."""
