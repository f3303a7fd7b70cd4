#![no_std]
//! facade
