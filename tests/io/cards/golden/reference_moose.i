# viscard 0.2.0: PDMS for MOOSE GeneralizedMaxwellModel
# units: mm-t-s (mm, t, s, N, MPa, t/mm3)
# conventions: instantaneous E, nu; branches absolute (E_i = g_i E_0); time tau; bulk relaxes with the shear (constant nu)
# E0 (instantaneous) = 1.88 MPa, E_inf (long-term) = 1.83851592 MPa
# K0 = 62.66666667 MPa from nu = 0.495 (assumed)
# rho = 9.65e-10 t/mm3
# terms: exact, 2
# bulk: exact, relaxes with the shear (constant nu) (assumed)
# numbers: exact
# density: exact
# valid: 0.0125 s to 60 s, strain up to 0.05, temperature not stated
# tests behind it: 1
# raw data run.viscap sha256 aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa
# card sha256 949656df01e3ccd85d46c2fd24a2b49001241f65277200ac955cee4ccb820538
# creep_viscosity is the relaxation time. Keep the UserObject, or nothing relaxes. zienkiewicz is exact for steps of one size; where the size changes, MOOSE uses the old one once.
[Materials]
  [PDMS]
    type = GeneralizedMaxwellModel
    young_modulus = 1.88
    poisson_ratio = 0.495
    integration_rule = zienkiewicz
    creep_modulus = '0.015427279999999998 0.0260568'
    creep_viscosity = '0.1945 2.403'
  []
  [creep]
    type = LinearViscoelasticStressUpdate
  []
  [stress]
    type = ComputeMultipleInelasticStress
    inelastic_models = 'creep'
  []
  [strain]
    type = ComputeIncrementalSmallStrain
    displacements = 'disp_x disp_y disp_z'
  []
  [density]
    type = GenericConstantMaterial
    prop_names = 'density'
    prop_values = '9.65e-10'
  []
[]
[UserObjects]
  [update]
    type = LinearViscoelasticityManager
    viscoelastic_model = PDMS
  []
[]
