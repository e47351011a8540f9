//! Volumes and Euler characteristics against closed forms.
