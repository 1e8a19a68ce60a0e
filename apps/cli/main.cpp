// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
int main() { return 2; }
