!> What a case file says of the film: its gas, and a bore that is no circle.
module gfb_film_cases
  use gfb_bore_case, only: bore_case_type
  use gfb_gas_case, only: gas_case_type
  implicit none (type, external)
  private
  public :: bore_case_type, gas_case_type
end module gfb_film_cases
